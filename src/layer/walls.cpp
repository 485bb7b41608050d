#include "layer/walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/place_text.h"
#include "remodel/error.h"

namespace remodel {

namespace {

// Boundaries that a flow passes or glides along, where nothing says which are walls.
constexpr std::array known_openings{"axis", "farfield", "inflow", "inlet", "outflow", "outlet", "symmetry"};

// Upper case and numbers at the end are as good: Inlet, outlet_1, SYMMETRY-2.
bool is_known_opening(const Curve& curve) {
  std::string name = curve.name;
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::size_t end = name.find_last_not_of("0123456789");
  if (end != std::string::npos && end + 1 < name.size()) name.resize(name.find_last_not_of("_-. ", end) + 1);
  return std::find(known_openings.begin(), known_openings.end(), name) != known_openings.end();
}

std::string curve_text(const Domain& domain, std::size_t loop, std::size_t curve) {
  return "loop " + std::to_string(loop) + ", curve \"" + domain.loops[loop].curves[curve].name + "\"";
}

void require_names(const Domain& domain, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    bool found = false;
    for (const Loop& loop : domain.loops)
      for (const Curve& curve : loop.curves) {
        if (curve.name != name) continue;
        found = true;
        if (loop.open || loop.role == LoopRole::internal)
          throw Error(
              ErrorCode::argument, "walls",
              "found boundary '" + name +
                  "', which is an open chain or lies inside the domain, expected curves of closed loops");
      }
    if (!found)
      throw Error(ErrorCode::argument, "walls", "found '" + name + "', expected a boundary of the domain");
  }
}

// A point of a loop and its neighbours.
struct LoopCorner {
  Point before, at, after;
};

LoopCorner corner_at(const std::vector<Point>& points, std::size_t i) {
  const std::size_t n = points.size();
  return {points[i == 0 ? n - 1 : i - 1], points[i], points[i + 1 == n ? 0 : i + 1]};
}

// Which curves of a loop get a layer, and the walls that these make.
class LoopWalls {
 public:
  LoopWalls(const Walls& walls, std::size_t loop, const LayerOptions& options)
      : walls_(walls), loop_(loop), curves_(walls.domain.loops[loop].curves), options_(options) {
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      layered_.push_back(is_wall(walls.domain, loop, c, options.walls));
      first_station_.push_back(stations_);
      stations_ += curves_[c].parameters.size();
    }
    if (std::find(layered_.begin(), layered_.end(), true) == layered_.end()) return;
    carry_on();
    find();
  }
  std::vector<LayeredWall> take() { return std::move(found_); }

 private:
  std::size_t after(std::size_t curve) const { return curve + 1 == curves_.size() ? 0 : curve + 1; }

  void carry_on() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t c = 0; c < curves_.size(); ++c) {
        const std::size_t next = after(c);
        if (layered_[c] == layered_[next]) continue;
        const LoopCorner corner = corner_at(walls_.points[loop_], first_station_[next]);
        if (bends_by_30_degrees(corner.before, corner.at, corner.after)) continue;
        layered_[c] = layered_[next] = changed = true;
      }
    }
  }

  void find() {
    if (std::find(layered_.begin(), layered_.end(), false) == layered_.end()) {
      found_.push_back({.loop = loop_, .curves = curves_.size(), .stations = stations_, .closed = true});
      return;
    }
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      if (!layered_[after(c)] || layered_[c]) continue;
      LayeredWall wall{
          .loop = loop_, .first = after(c), .station = first_station_[after(c)], .closed = false};
      for (std::size_t k = wall.first; layered_[k]; k = after(k)) {
        ++wall.curves;
        wall.stations += curves_[k].parameters.size();
      }
      ++wall.stations;
      require_openings(wall);
      found_.push_back(wall);
    }
    std::sort(found_.begin(), found_.end(),
              [](const LayeredWall& a, const LayeredWall& b) { return a.first < b.first; });
  }

  void require_openings(const LayeredWall& wall) const {
    const std::size_t last = (wall.first + wall.curves) % curves_.size();
    if (walls_.domain.loops[loop_].placement != Placement{})
      throw Error(ErrorCode::geometry, "layers",
                  "found a placement of the loop of " + curve_text(walls_.domain, loop_, wall.first) +
                      ", whose wall ends at an opening, expected none");
    for (const std::size_t curve : {wall.first == 0 ? curves_.size() - 1 : wall.first - 1, last})
      if (const Shape& shape = curves_[curve].shape;
          std::holds_alternative<Spline>(shape) || std::holds_alternative<CstAirfoil>(shape))
        throw Error(ErrorCode::geometry, "layers",
                    "found an opening that is a spline or an airfoil, " +
                        curve_text(walls_.domain, loop_, curve) +
                        ", expected a line, a polyline or an arc where a wall with a layer ends");
    const Openings openings = openings_of(walls_, wall);
    const std::size_t end = first_station_[last];
    require_angle(openings[0], wall.station, true);
    require_angle(openings[1], end, false);
  }

  // Columns stand along the opening: between 60 and 120 degrees from the wall.
  void require_angle(const Opening& opening, std::size_t station, bool at_beginning) const {
    LoopCorner corner = corner_at(walls_.points[loop_], station);
    (at_beginning ? corner.before : corner.after) =
        opening.at(std::min(options_.thickness, opening.longest()));
    const Point before = corner.before - corner.at, after = corner.after - corner.at;
    const double sine = (walls_.on_left(loop_) ? 1.0 : -1.0) * cross(after, before);
    const double cosine = dot(after, before);
    const double lengths = std::sqrt(dot(before, before) * dot(after, after));
    if (sine > 0.0 && std::abs(cosine) <= (0.5 + 1e-9) * lengths) return;
    double degrees = std::atan2(sine, cosine) * (180.0 / std::numbers::pi);
    if (degrees < 0.0) degrees += 360.0;
    throw Error(ErrorCode::geometry, "layers",
                "found an angle of " + exact_text(std::round(10.0 * degrees) / 10.0) +
                    " degrees between the wall and " + curve_text(walls_.domain, loop_, opening.curve()) +
                    ", at " + exact_text(corner.at) +
                    ", expected 60 to 120 where a layer ends, or 150 to 210 where it goes on");
  }

  const Walls& walls_;
  std::size_t loop_;
  const std::vector<Curve>& curves_;
  const LayerOptions& options_;
  std::vector<bool> layered_;
  std::vector<std::size_t> first_station_;
  std::size_t stations_ = 0;
  std::vector<LayeredWall> found_;
};

// A line inside the domain that ends on a wall would have to end on the tops, and stations of openings make
// room for them.
void require_no_open_lines(const Walls& walls, const std::vector<LayeredWall>& layered) {
  std::vector<Point> ends;
  for (std::size_t l = 0; l < walls.points.size(); ++l)
    if (walls.domain.loops[l].open && !walls.points[l].empty())
      ends.insert(ends.end(), {walls.points[l].front(), walls.points[l].back()});
  if (ends.empty()) return;
  for (const LayeredWall& wall : layered) {
    const std::vector<Point>& points = walls.points[wall.loop];
    const auto joint = std::find_first_of(points.begin(), points.end(), ends.begin(), ends.end());
    if (joint == points.end()) continue;
    const auto station = static_cast<std::size_t>(joint - points.begin());
    const Curve& curve = walls.domain.curve(walls.domain.stations(wall.loop)[station].curve);
    throw Error(ErrorCode::geometry, "layers",
                "found an open line that ends on loop " + std::to_string(wall.loop) + ", curve \"" +
                    curve.name + "\", at " + exact_text(*joint) + ", expected walls that no line joins");
  }
}

Arc without_beginning(Arc arc, double part) {
  arc.start += part * arc.sweep;
  return arc;
}

}  // namespace

Walls::Walls(const Domain& of) : domain(of) {
  for (std::size_t l = 0; l < domain.loops.size(); ++l) points.push_back(domain.points(l));
}

std::vector<Point> Walls::points_of(const LayeredWall& wall) const {
  const std::vector<Point>& loop = points[wall.loop];
  if (wall.closed) return loop;
  std::vector<Point> chain;
  for (std::size_t k = 0; k < wall.stations; ++k) chain.push_back(loop[(wall.station + k) % loop.size()]);
  return chain;
}

bool Walls::on_left(std::size_t loop) const {
  const LoopRole role = domain.loops[loop].role;
  if (role == LoopRole::left || role == LoopRole::right) return role == LoopRole::left;
  const std::vector<Point>& polygon = points[loop];
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return (role == LoopRole::outer) == (twice > 0.0);
}

bool bends_by_30_degrees(Point before, Point at, Point after) {
  const Point u = at - before, v = after - at;
  return dot(u, v) < 0.5 * std::sqrt(3.0 * dot(u, u) * dot(v, v));
}

bool is_wall(const Domain& domain, std::size_t loop, std::size_t curve,
             const std::vector<std::string>& names) {
  const Loop& of = domain.loops[loop];
  if (of.open || of.role == LoopRole::internal) return false;
  const Curve& one = of.curves[curve];
  if (!names.empty()) return std::find(names.begin(), names.end(), one.name) != names.end();
  if (of.role != LoopRole::hole && of.role != LoopRole::outer) return false;
  const auto is_opening = [&](const Curve& c) {
    return is_known_opening(c) ||
           std::any_of(domain.periodic.begin(), domain.periodic.end(),
                       [&](const PeriodicPair& pair) { return c.name == pair.name || c.name == pair.moved; });
  };
  const auto openings = std::count_if(of.curves.begin(), of.curves.end(), is_opening);
  if (openings == 0 || openings == static_cast<std::ptrdiff_t>(of.curves.size()))
    return of.role == LoopRole::hole;
  return !is_opening(one);
}

std::vector<LayeredWall> layered_walls(const Walls& walls, const LayerOptions& options) {
  require_names(walls.domain, options.walls);
  std::vector<LayeredWall> layered;
  for (std::size_t l = 0; l < walls.domain.loops.size(); ++l)
    for (const LayeredWall& wall : LoopWalls(walls, l, options).take()) layered.push_back(wall);
  if (layered.empty())
    throw Error(
        ErrorCode::argument, "walls",
        "found a domain without holes, and without an outer loop of which some curves are called inlet, "
        "outlet, symmetry or farfield, expected a wall for the layer, or the names of walls");
  require_no_open_lines(walls, layered);
  return layered;
}

std::vector<LayeredWall> layered_walls(const Domain& domain, const LayerOptions& options) {
  return layered_walls(Walls(domain), options);
}

Opening::Opening(const Loop& loop, std::size_t curve, bool begins, Point corner)
    : shape_(loop.curves[curve].shape),
      curve_(curve),
      begins_(begins),
      beside_(corner - point_at(shape_, begins ? 0.0 : 1.0)) {
  if (const auto* arc = std::get_if<Arc>(&shape_)) length_ = arc->radius * std::abs(arc->sweep);
  if (const auto* line = std::get_if<Line>(&shape_)) length_ = distance(line->from, line->to);
  if (const auto* polyline = std::get_if<Polyline>(&shape_)) {
    const std::vector<Point>& points = polyline->points;
    pieces_ = static_cast<double>(points.size() - 1);
    length_ = begins ? distance(points[0], points[1]) : distance(points[points.size() - 2], points.back());
  }
}

Point Opening::at(double distance) const {
  // The bits of what is left of the arc, which begins there.
  if (const auto* arc = std::get_if<Arc>(&shape_); arc != nullptr && begins_)
    return point_at(without_beginning(*arc, part(distance)), 0.0) + beside_;
  return point_at(shape_, parameter(distance)) + beside_;
}

Openings openings_of(const Walls& walls, const LayeredWall& wall) {
  const Loop& loop = walls.domain.loops[wall.loop];
  const std::vector<Point>& points = walls.points[wall.loop];
  const std::size_t n = loop.curves.size();
  const Point first = points[wall.station], last = points[(wall.station + wall.stations - 1) % points.size()];
  return {Opening(loop, wall.first == 0 ? n - 1 : wall.first - 1, false, first),
          Opening(loop, (wall.first + wall.curves) % n, true, last)};
}

}  // namespace remodel
