// Ends of chains that miss what they were meant to meet by rounding. First ends are moved onto stations, or
// the station onto the end where that alone can be moved; then what is still as near is refused by its two
// places.

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "geometry/near_points.h"
#include "geometry/place_text.h"
#include "remodel/error.h"
#include "remodel/join.h"

namespace remodel {
namespace {

// A vertex of the discretised boundary, by its place in the domain.
struct Station {
  std::size_t loop, curve;  // of the loop
  double t;
  Point at;
  bool end;  // of a chain
};

// Of what validate() will refuse nothing is joined.
bool can_be_read(const Loop& loop) {
  return !loop.curves.empty() && std::all_of(loop.curves.begin(), loop.curves.end(), [](const Curve& curve) {
    const auto not_increasing = [](double a, double b) { return !(a < b); };
    const auto& t = curve.parameters;
    return !t.empty() && t.front() == 0.0 && t.back() < 1.0 &&
           std::adjacent_find(t.begin(), t.end(), not_increasing) == t.end();
  });
}

std::vector<Station> stations_of(const Domain& domain, std::size_t index) {
  const Loop& loop = domain.loops[index];
  const Frame frame(loop.placement);
  std::vector<Station> result;
  for (std::size_t c = 0; c < loop.curves.size(); ++c)
    for (const double t : loop.curves[c].parameters)
      result.push_back({index, c, t, frame(point_at(loop.curves[c].shape, t)), false});
  if (!loop.open || is_single_point(loop)) return result;
  const std::size_t last = loop.curves.size() - 1;
  result.push_back({index, last, 1.0, frame(point_at(loop.curves[last].shape, 1.0)), true});
  result.front().end = true;
  return result;
}

// ---- Moving one place of a curve ----

bool move_place(Line& line, double t, Point to) {
  if (t == 0.0) line.from = to;
  if (t == 1.0) line.to = to;
  return t == 0.0 || t == 1.0;
}
bool move_place(Polyline& polyline, double t, Point to) {
  const double place = t * static_cast<double>(polyline.points.size() - 1);
  const auto index = static_cast<std::size_t>(std::llround(place));
  if (index >= polyline.points.size()) return false;
  polyline.points[index] = to;
  return true;  // whether it was that point, who asked looks after
}
bool move_place(Spline& spline, double t, Point to) {
  if (t != 0.0 && t != 1.0) return false;
  std::vector<Point> points = spline.points;
  (t == 0.0 ? points.front() : points.back()) = to;
  if (spline.points.front() == spline.points.back()) points.front() = points.back() = to;
  spline = spline_through(std::move(points), spline.corner ? SplineEnds::corner : SplineEnds::smooth);
  return true;
}
template <class Rigid>
bool move_place(Rigid&, double, Point) {  // arcs and airfoils are given by other numbers than points
  return false;
}

// Whether the curve now passes `to` at t, and all its other stations are where they were or moved as little.
bool move_station(Domain& domain, const Station& station, Point to) {
  Loop& loop = domain.loops[station.loop];
  if (!(loop.placement == Placement{})) return false;
  Curve& curve = loop.curves[station.curve];
  const Shape before = curve.shape;
  const bool moved = std::visit([&](auto& shape) { return move_place(shape, station.t, to); }, curve.shape);
  if (!moved || !(point_at(curve.shape, station.t) == to)) {
    curve.shape = before;
    return false;
  }
  // The curve before ends there too.
  if (station.t == 0.0 && (station.curve > 0 || !loop.open)) {
    Curve& previous = loop.curves[(station.curve + loop.curves.size() - 1) % loop.curves.size()];
    if (&previous != &curve && point_at(previous.shape, 1.0) == station.at)
      std::visit([&](auto& shape) { return move_place(shape, 1.0, to); }, previous.shape);
  }
  return true;
}

// ---- Words ----

std::string place_of(const Domain& domain, const Station& station) {
  return "loop " + std::to_string(station.loop) + ", curve \"" +
         domain.loops[station.loop].curves[station.curve].name + "\", at " + exact_text(station.at);
}

[[noreturn]] void refuse(const std::string& source, const std::string& one, const std::string& other,
                         double distance, const std::string& expected) {
  throw Error(ErrorCode::geometry, source,
              one + " and " + other + " are " + rough_text(distance) +
                  " apart, which is rounding: expected " + expected +
                  ", or --join 0 to take them as they are");
}

// ---- The work ----

class EndJoiner {
 public:
  EndJoiner(Domain& domain, const std::string& source, Joins& joins)
      : domain_(domain), source_(source), joins_(joins) {}

  void run() {
    collect();
    for (std::size_t i = 0; i < stations_.size(); ++i)
      if (stations_[i].end) settle(i);
  }

 private:
  void collect() {
    stations_.clear();
    targets_ = NearPoints(joins_.tolerance);
    for (std::size_t loop = 0; loop < domain_.loops.size(); ++loop)
      for (const Station& station : stations_of(domain_, loop)) {
        if (!station.end) targets_.add(station.at, stations_.size());
        stations_.push_back(station);
      }
  }

  // An end may meet any station of other loops, and the other end of its own.
  void settle(std::size_t i) {
    const auto wanted = [&](std::size_t k) {
      return !stale_.contains(k) && (stations_[k].loop != stations_[i].loop || stations_[k].end);
    };
    const auto near = targets_.nearest(stations_[i].at, wanted);
    if (near && near->distance > 0.0) {
      count(i, *near);
      if (move_station(domain_, stations_[i], stations_[near->id].at)) {
        stations_[i].at = stations_[near->id].at;
      } else if (!move_station(domain_, stations_[near->id], stations_[i].at)) {
        refuse(source_, place_of(domain_, stations_[i]), place_of(domain_, stations_[near->id]),
               near->distance, "one place");
      } else {
        stale_.insert(near->id);
        stations_[near->id].at = stations_[i].at;
      }
    }
    targets_.add(stations_[i].at, i);
  }

  void count(std::size_t i, const NearPoints::Found& near) {
    if (joins_.count++ == 0)
      joins_.first = place_of(domain_, stations_[i]) + " with " + place_of(domain_, stations_[near.id]);
    joins_.largest = std::max(joins_.largest, near.distance);
  }

  Domain& domain_;
  const std::string& source_;
  Joins& joins_;
  std::vector<Station> stations_;
  NearPoints targets_{1.0};
  std::set<std::size_t> stale_;  // targets that were moved: the end there stands for them
};

double distance_to_side(Point p, Point from, Point to) {
  const Point along = to - from, q = p - from;
  const double length = dot(along, along);
  const double share = length > 0.0 ? std::clamp(dot(q, along) / length, 0.0, 1.0) : 0.0;
  return std::sqrt(squared_distance(q, share * along));
}

// What is left must be apart, or together to the last bit.
class NearMisses {
 public:
  NearMisses(const Domain& domain, const std::string& source, double tolerance)
      : domain_(domain), source_(source), tolerance_(tolerance) {
    for (std::size_t loop = 0; loop < domain.loops.size(); ++loop)
      for (const Station& station : stations_of(domain, loop)) stations_.push_back(station);
    for (std::size_t i = 0; i < stations_.size(); ++i) order_.push_back(i);
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(stations_[a].at.x, a) < std::pair(stations_[b].at.x, b);
    });
  }

  void refuse_first() const {
    for (std::size_t begin = 0, end = 0; begin < stations_.size(); begin = end) {
      while (end < stations_.size() && stations_[end].loop == stations_[begin].loop) ++end;
      const bool open = domain_.loops[stations_[begin].loop].open;
      for (std::size_t i = begin; i + (open && end - begin > 1 ? 1 : 0) < end; ++i)
        compare(stations_[i], stations_[i + 1 < end ? i + 1 : begin]);
    }
  }

 private:
  void compare(const Station& from, const Station& to) const {
    const double low = std::min(from.at.x, to.at.x) - tolerance_,
                 high = std::max(from.at.x, to.at.x) + tolerance_;
    const double bottom = std::min(from.at.y, to.at.y) - tolerance_,
                 top = std::max(from.at.y, to.at.y) + tolerance_;
    auto next = std::lower_bound(order_.begin(), order_.end(), low,
                                 [&](std::size_t i, double x) { return stations_[i].at.x < x; });
    for (; next != order_.end() && stations_[*next].at.x <= high; ++next) {
      const Station& other = stations_[*next];
      if (other.loop == from.loop || !(other.at.y >= bottom && other.at.y <= top)) continue;
      if (other.at == from.at || other.at == to.at) continue;
      const double distance = distance_to_side(other.at, from.at, to.at);
      if (distance > 0.0 && distance <= tolerance_)
        refuse(source_, place_of(domain_, other), place_of(domain_, from) + " to " + exact_text(to.at) + ",",
               distance, other.end ? "a station there that the end lies on" : "walls that are apart");
    }
  }

  const Domain& domain_;
  const std::string& source_;
  double tolerance_;
  std::vector<Station> stations_;
  std::vector<std::size_t> order_;  // by x
};

double extent_of(const Domain& domain) {
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (std::size_t loop = 0; loop < domain.loops.size(); ++loop)
    for (const Point p : domain.points(loop)) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) return INFINITY;
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  const double largest = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  return std::max(std::sqrt(squared_distance(low, high)), largest);
}

}  // namespace

void require_join(double join) {
  if (join == 0.0 || (join >= 1e-15 && join <= 0.01)) return;
  throw Error(ErrorCode::argument, "join",
              "found " + exact_text(join) + ", expected 0 or 1e-15 to 0.01 of the size of the input");
}

Joins join_ends(Domain& domain, const std::string& source, double join) {
  require_join(join);
  Joins joins;
  if (join == 0.0 || !std::all_of(domain.loops.begin(), domain.loops.end(), can_be_read)) return joins;
  const double extent = extent_of(domain);
  if (!(extent > 0.0 && extent <= 1e60)) return joins;
  joins.tolerance = join * extent;
  EndJoiner(domain, source, joins).run();
  NearMisses(domain, source, joins.tolerance).refuse_first();
  return joins;
}

}  // namespace remodel
