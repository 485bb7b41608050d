// What a domain has to fulfil before anything meshes it, in the order in which it is checked: the curves' own
// figures, their discretisation, the polygon of every loop, all polygons together, what lies inside what.

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/predicates.h"
#include "segments.h"

namespace remodel {
namespace {

// A curve ends where the next one begins up to rounding, relative to the coordinates. Decides nothing but
// whether the description makes sense: the polygon takes the next curve's first point.
constexpr double joint_tolerance = 1e-9;

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream problem;
  problem.precision(10);
  (problem << ... << parts);
  throw Error(ErrorCode::geometry, nameless_domain, problem.str());
}

std::string place_of(const Domain& domain, std::size_t curve_index) {
  return "loop " + std::to_string(domain.loop_of(curve_index)) + ", curve \"" +
         domain.curve(curve_index).name + "\"";
}

std::string place_of(const Domain& domain, BoundaryStation station) {
  const Point p = domain.at(station);
  std::ostringstream text;
  text.precision(10);
  text << place_of(domain, station.curve) << ", t = " << station.t << " (" << p.x << ", " << p.y << ")";
  return text.str();
}

bool is_finite(Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

void check_shape(const CstAirfoil& airfoil, const std::string& place) {
  if (airfoil.upper.size() != airfoil.lower.size() || airfoil.upper.size() < 2) {
    refuse(place, ": found ", airfoil.upper.size(), " upper and ", airfoil.lower.size(),
           " lower coefficients, expected the same number of both, at least 2");
  }
  if (!surfaces_apart(airfoil)) {
    refuse(place, ": the airfoil's surfaces touch or cross, expected the upper one above the lower one");
  }
}
void check_shape(const Line& line, const std::string& place) {
  if (!is_finite(line.from) || !is_finite(line.to)) refuse(place, ": expected a line with finite ends");
}
void check_shape(const Polyline& polyline, const std::string& place) {
  if (polyline.points.size() < 2 || !std::all_of(polyline.points.begin(), polyline.points.end(), is_finite)) {
    refuse(place, ": expected a polyline of at least 2 finite points");
  }
}
void check_shape(const Arc& arc, const std::string& place) {
  if (!is_finite(arc.centre) || !std::isfinite(arc.start) || !std::isfinite(arc.sweep) ||
      !(arc.radius > 0.0) || !std::isfinite(arc.radius)) {
    refuse(place, ": expected an arc of finite centre, angles and radius, the radius positive");
  }
}

void check_shape(const Spline& spline, const std::string& place) {
  const std::size_t n = spline.points.size();
  const auto increasing = [](const std::vector<double>& knots) {
    return std::is_sorted(knots.begin(), knots.end(), std::less_equal<>());
  };
  if (n < 2 || !std::all_of(spline.points.begin(), spline.points.end(), is_finite) ||
      spline.knots.size() != n || spline.second.size() != n || !increasing(spline.knots) ||
      spline.knots.front() != 0.0 || spline.knots.back() != 1.0) {
    refuse(place, ": expected a spline of at least 2 finite points, as spline_through() makes it");
  }
}

void check_parameters(const std::vector<double>& parameters, const std::string& place) {
  if (parameters.empty() || parameters.front() != 0.0)
    refuse(place, ": expected parameters that begin with 0");
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    if (parameters[i] > parameters[i - 1] && parameters[i] < 1.0) continue;
    refuse(place, ": found parameter ", parameters[i], " after ", parameters[i - 1],
           ", expected them strictly increasing and below 1");
  }
}

// The sides of one loop's polygon; `first` is the index of the first of them among all.
std::vector<Side> sides_of(const Domain& domain, std::size_t loop, std::size_t first) {
  const std::vector<Point> points = domain.points(loop);
  const auto place = [&](std::size_t i) { return place_of(domain, domain.stations(loop)[i]); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!safe_for_predicates(points[i]))
      refuse(place(i), ": expected coordinates that are 0 or of magnitude 1e-60 to 1e60");
  }
  if (points.size() == 1) return {{.from = points[0], .to = points[0], .first = true}};
  const bool open = domain.loops[loop].open;
  std::vector<Side> sides;
  sides.reserve(points.size());
  for (std::size_t i = 0; i + (open ? 1 : 0) < points.size(); ++i) {
    const std::size_t next = i + 1 == points.size() ? 0 : i + 1;
    if (points[i] == points[next])
      refuse(place(i), ": found the same point twice in a row, expected different points");
    const bool last = open && i + 2 == points.size();
    sides.push_back({.from = points[i],
                     .to = points[next],
                     .next = last ? no_side : first + next,
                     .first = open && i == 0});
  }
  return sides;
}

void check_joints(const Loop& loop, std::size_t first_curve, const Domain& domain) {
  for (std::size_t c = 0; c + (loop.open ? 1 : 0) < loop.curves.size(); ++c) {
    const Point end = point_at(loop.curves[c].shape, 1.0);
    const Point begin = point_at(loop.curves[(c + 1) % loop.curves.size()].shape, 0.0);
    const double size = std::max({std::abs(end.x), std::abs(end.y), std::abs(begin.x), std::abs(begin.y)});
    if (std::hypot(end.x - begin.x, end.y - begin.y) <= joint_tolerance * size) continue;
    refuse(place_of(domain, first_curve + c), " ends at (", end.x, ", ", end.y,
           "), expected the beginning of the loop's next curve, (", begin.x, ", ", begin.y, ")");
  }
}

void check_loop(const Domain& domain, std::size_t loop_index, std::size_t first_curve) {
  const Loop& loop = domain.loops[loop_index];
  std::size_t points = 0;
  for (std::size_t c = 0; c < loop.curves.size(); ++c) {
    const std::string place =
        "loop " + std::to_string(loop_index) + ", curve \"" + loop.curves[c].name + "\"";
    std::visit([&](const auto& shape) { check_shape(shape, place); }, loop.curves[c].shape);
    check_parameters(loop.curves[c].parameters, place);
    points += loop.curves[c].parameters.size();
  }
  if (!loop.open && points < 3)
    refuse("loop ", loop_index, ": found ", points, " points, expected at least 3");
  if (loop.open && points == 0) refuse("loop ", loop_index, ": found an open chain without a curve");
  if (loop.open && (loop.role == LoopRole::outer || loop.role == LoopRole::hole)) {
    refuse("loop ", loop_index, ": found an open chain of the role ", name_of(loop.role),
           ", expected internal, left or right");
  }
  const Placement& placement = loop.placement;
  if (!std::isfinite(placement.chord) || placement.chord <= 0.0 || !std::isfinite(placement.rotation_deg) ||
      !is_finite(placement.position)) {
    refuse("loop ", loop_index,
           ": expected a placement of positive finite chord, finite rotation and position");
  }
  check_joints(loop, first_curve, domain);
}

// The place where the side of this index among all begins.
std::string place_of_side(const Domain& domain, const std::vector<std::vector<Side>>& polygons,
                          std::size_t side) {
  std::size_t loop = 0;
  for (; side >= polygons[loop].size(); ++loop) side -= polygons[loop].size();
  return place_of(domain, domain.stations(loop)[side]);
}

struct LoopBox {
  Point low, high;
  bool holds(Point p) const { return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y; }
};

LoopBox box_of(const std::vector<Side>& polygon) {
  LoopBox box{polygon.front().from, polygon.front().from};
  for (const Side& side : polygon) {
    box.low = {std::min(box.low.x, side.from.x), std::min(box.low.y, side.from.y)};
    box.high = {std::max(box.high.x, side.from.x), std::max(box.high.y, side.from.y)};
  }
  return box;
}

bool takes_turns(LoopRole role) {
  return role == LoopRole::outer || role == LoopRole::hole;
}

// As no two loops meet, one point of a loop says which loops it lies in. From the outside in, the roles take
// turns: an outermost loop is outer, what lies directly in an outer loop is a hole, what lies directly in a
// hole is outer again (an island). Boundaries of chains may lie between: then this says nothing.
void check_nesting(const Domain& domain, const std::vector<std::vector<Side>>& polygons) {
  for (const Loop& loop : domain.loops)
    if (loop.role == LoopRole::left || loop.role == LoopRole::right) return;
  std::vector<LoopBox> boxes;
  for (const std::vector<Side>& polygon : polygons) boxes.push_back(box_of(polygon));
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (!takes_turns(domain.loops[i].role)) continue;
    const Point p = polygons[i].front().from;
    std::size_t around = 0;
    for (std::size_t j = 0; j < polygons.size(); ++j) {
      if (j != i && takes_turns(domain.loops[j].role) && boxes[j].holds(p) && is_inside(polygons[j], p))
        ++around;
    }
    const LoopRole expected = around % 2 == 0 ? LoopRole::outer : LoopRole::hole;
    if (domain.loops[i].role == expected) continue;
    refuse("loop ", i, ": found a", expected == LoopRole::outer ? " hole" : "n outer loop", " inside ",
           around,
           " other loops, expected every hole directly inside an outer loop and no outer loop directly "
           "inside another");
  }
}

}  // namespace

void validate(const Domain& domain) {
  if (domain.loops.empty()) refuse("found no loop, expected at least one");
  std::vector<std::vector<Side>> polygons;
  std::vector<Side> all;
  std::size_t first_curve = 0;
  for (std::size_t loop = 0; loop < domain.loops.size(); ++loop) {
    check_loop(domain, loop, first_curve);
    first_curve += domain.loops[loop].curves.size();
    polygons.push_back(sides_of(domain, loop, all.size()));
    all.insert(all.end(), polygons.back().begin(), polygons.back().end());
  }
  if (const auto pair = find_meeting_sides(all)) {
    refuse("the sides that begin at ", place_of_side(domain, polygons, pair->first), " and ",
           place_of_side(domain, polygons, pair->second), " touch or cross");
  }
  check_nesting(domain, polygons);
  periodic_curves(domain);
}

Error from_file(const Error& error, const std::string& source) {
  const std::string_view text = error.what(), name = nameless_domain;
  if (!text.starts_with(name) || !text.substr(name.size()).starts_with(": ")) return error;
  return {error.code(), source, std::string(text.substr(name.size() + 2))};
}

void validate(const Domain& domain, const std::string& source) {
  try {
    validate(domain);
  } catch (const Error& error) {
    throw from_file(error, source);
  }
}

}  // namespace remodel
