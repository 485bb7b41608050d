#include "remodel/domain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "remodel/error.h"
#include "turn.h"
#include "turning_stations.h"

namespace remodel {
namespace {

Point point_on(const CstAirfoil& airfoil, double t) {
  return airfoil.at(t);
}

// Exactly `from` at 0 and `to` at 1.
Point point_on(const Line& line, double t) {
  return (1.0 - t) * line.from + t * line.to;
}

Point point_on(const Polyline& polyline, double t) {
  assert(polyline.points.size() >= 2);
  const double pieces = static_cast<double>(polyline.points.size() - 1);
  const double s = t * pieces;
  const double knot = std::round(s);
  if (knot / pieces == t) return polyline.points[static_cast<std::size_t>(knot)];  // exact at its corners
  const double piece = std::min(std::floor(s), pieces - 1.0);
  const std::size_t i = static_cast<std::size_t>(piece);
  return point_on(Line{polyline.points[i], polyline.points[i + 1]}, s - piece);
}

Point point_on(const Arc& arc, double t) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  return arc.centre + arc.radius * direction(arc.start / full_turn + t * (arc.sweep / full_turn));
}

// Exactly a point of the spline at its knot.
Point point_on(const Spline& spline, double t) {
  assert(spline.points.size() >= 2);
  const auto above = std::upper_bound(spline.knots.begin() + 1, spline.knots.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - spline.knots.begin()) - 1;
  if (t == spline.knots[i]) return spline.points[i];
  if (t == spline.knots[i + 1]) return spline.points[i + 1];
  const double h = spline.knots[i + 1] - spline.knots[i];
  const double b = (t - spline.knots[i]) / h, a = 1.0 - b;
  return a * spline.points[i] + b * spline.points[i + 1] +
         (h * h / 6.0) * ((a * a * a - a) * spline.second[i] + (b * b * b - b) * spline.second[i + 1]);
}

// i/n for i = 0 ... n-1, with the second half mirrored from the first: fractions i and n-i add up to 1 as
// fold() sees them, which dividing both would miss by a rounding here and there.
std::vector<double> mirrored_fractions(int n) {
  std::vector<double> fractions(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    fractions[static_cast<std::size_t>(i)] =
        2 * i <= n ? static_cast<double>(i) / n : 1.0 - static_cast<double>(n - i) / n;
  }
  return fractions;
}

void expect(bool fulfilled, const char* option, double found, const char* expected) {
  if (fulfilled) return;
  std::ostringstream problem;
  problem.precision(17);
  problem << "found " << found << ", expected " << expected;
  throw Error(ErrorCode::argument, option, problem.str());
}

void check_options(const AirfoilDomainOptions& options) {
  expect(options.points >= 8 && options.points <= 100000 && options.points % 2 == 0, "points", options.points,
         "an even number from 8 to 100000");
  expect(options.farfield_points >= 8 && options.farfield_points <= 100000, "farfield points",
         options.farfield_points, "a number from 8 to 100000");
  expect(options.farfield_radius > 1.0 && options.farfield_radius <= 1e6, "farfield radius",
         options.farfield_radius, "more than 1 and at most 1e6 chords");
  const double share = options.turning_share.value_or(0.0);
  expect(share >= 0.0 && share <= 0.9, "turning share", share, "a part from 0 to 0.9");
}

// No point of the airfoil is farther from the farfield's centre: x / chord is in [0, 1], and where the
// exponents are not negative, neither the class function nor a Bernstein polynomial exceeds one.
double reach_bound(const PlacedAirfoil& placed, Point centre) {
  const CstAirfoil& airfoil = placed.airfoil;
  if (!placed.outline.empty()) return std::numeric_limits<double>::infinity();
  if (!(airfoil.e1 >= 0.0 && airfoil.e2 >= 0.0)) return std::numeric_limits<double>::infinity();
  double height = std::abs(airfoil.te_upper) + std::abs(airfoil.te_lower);
  for (const auto* surface : {&airfoil.upper, &airfoil.lower})
    for (const double coefficient : *surface) height += std::abs(coefficient);
  const Placement& at = placed.placement;
  return std::abs(at.position.x - centre.x) + std::abs(at.position.y - centre.y) + at.chord * (1.0 + height);
}

// The farfield is a polygon: what it surely contains is its inscribed circle.
void check_farfield_contains(const Domain& domain, std::size_t loop, const PlacedAirfoil& airfoil,
                             const AirfoilDomainOptions& options) {
  const double inside = options.farfield_radius * std::cos(std::numbers::pi / options.farfield_points);
  const Point centre = options.farfield_centre;
  if (reach_bound(airfoil, centre) < inside * (1.0 - 1e-9)) return;
  for (const Point p : domain.points(loop)) {
    const double distance = std::hypot(p.x - centre.x, p.y - centre.y);
    if (distance < inside) continue;
    std::ostringstream problem;
    problem << "found " << options.farfield_radius
            << ", expected a farfield that contains the airfoil, which reaches " << distance
            << " chords from (" << centre.x << ", " << centre.y << ")";
    throw Error(ErrorCode::argument, "farfield radius", problem.str());
  }
}

bool all_finite(const CstAirfoil& airfoil) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(airfoil.upper.begin(), airfoil.upper.end(), finite) &&
         std::all_of(airfoil.lower.begin(), airfoil.lower.end(), finite) && finite(airfoil.te_upper) &&
         finite(airfoil.te_lower);
}

Loop airfoil_loop(const PlacedAirfoil& placed, int points, double turning_share) {
  const CstAirfoil& airfoil = placed.airfoil;
  if (!placed.outline.empty())
    return {.role = LoopRole::hole, .curves = placed.outline, .placement = placed.placement};
  expect(airfoil.upper.size() >= 2 && airfoil.upper.size() == airfoil.lower.size(), "airfoil coefficients",
         static_cast<double>(airfoil.lower.size()), "as many lower as upper ones, at least 2");
  if (!all_finite(airfoil))
    throw Error(ErrorCode::argument, "airfoil coefficients",
                "found one that is not finite, expected numbers");
  expect(placed.placement.chord > 0.0 && std::isfinite(placed.placement.chord), "chord",
         placed.placement.chord, "more than 0");
  const Parameters stations =
      turning_share > 0.0 ? turning_stations(airfoil, points, turning_share) : mirrored_fractions(points);
  Loop body{.role = LoopRole::hole,
            .curves = {{.name = placed.name, .shape = airfoil, .parameters = stations}},
            .placement = placed.placement};
  if (airfoil.te_upper != airfoil.te_lower) {
    const Line trailing_edge{.from = airfoil.at(1.0), .to = airfoil.at(0.0)};
    body.curves.push_back({.name = placed.name, .shape = trailing_edge, .parameters = {0.0}});
  }
  return body;
}

}  // namespace

const char* name_of(LoopRole role) {
  constexpr const char* names[] = {"outer", "hole", "internal", "left", "right"};
  return names[static_cast<std::size_t>(role)];
}

Point point_at(const Shape& shape, double t) {
  return std::visit([t](const auto& s) { return point_on(s, t); }, shape);
}

std::size_t Domain::curve_count() const {
  std::size_t count = 0;
  for (const Loop& loop : loops) count += loop.curves.size();
  return count;
}

std::size_t Domain::loop_of(std::size_t curve_index) const {
  std::size_t end = 0;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    end += loops[l].curves.size();
    if (curve_index < end) return l;
  }
  assert(false && "no such curve");
  return loops.size();
}

const Curve& Domain::curve(std::size_t index) const {
  for (const Loop& loop : loops) {
    if (index < loop.curves.size()) return loop.curves[index];
    index -= loop.curves.size();
  }
  assert(false && "no such curve");
  return loops.back().curves.back();
}

Point Domain::at(BoundaryStation station) const {
  const Loop& loop = loops[loop_of(station.curve)];
  return Frame(loop.placement)(point_at(curve(station.curve).shape, station.t));
}

bool is_single_point(const Loop& loop) {
  if (!loop.open || loop.curves.size() != 1) return false;
  const Line* line = std::get_if<Line>(&loop.curves.front().shape);
  return line != nullptr && line->from == line->to;
}

namespace {

template <class Visit>
void for_each_station(const Loop& loop, Visit visit) {
  for (std::size_t c = 0; c < loop.curves.size(); ++c)
    for (const double t : loop.curves[c].parameters) visit(c, t);
  if (loop.open && !loop.curves.empty() && !is_single_point(loop)) visit(loop.curves.size() - 1, 1.0);
}

}  // namespace

std::vector<BoundaryStation> Domain::stations(std::size_t loop) const {
  assert(loop < loops.size());
  std::size_t first_curve = 0;
  for (std::size_t l = 0; l < loop; ++l) first_curve += loops[l].curves.size();
  std::vector<BoundaryStation> result;
  for_each_station(loops[loop], [&](std::size_t curve, double t) {
    result.push_back({first_curve + curve, t});
  });
  return result;
}

std::vector<Point> Domain::points(std::size_t loop) const {
  const Frame frame(loops[loop].placement);
  std::vector<Point> result;
  for_each_station(loops[loop], [&](std::size_t curve, double t) {
    result.push_back(frame(point_at(loops[loop].curves[curve].shape, t)));
  });
  return result;
}

double signed_area(const Domain& domain, std::size_t loop) {
  const std::vector<Point> points = domain.points(loop);
  if (points.size() < 3) return 0.0;
  const Point origin = points.front();  // relative to a corner: far loops lose no digits
  double twice = 0.0;
  Point previous = points[1] - origin;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Point next = points[i] - origin;
    twice += cross(previous, next);
    previous = next;
  }
  return 0.5 * twice;
}

Parameters Parameters::uniform(std::size_t pieces) {
  std::vector<double> values(pieces);
  for (std::size_t i = 0; i < pieces; ++i) values[i] = static_cast<double>(i) / static_cast<double>(pieces);
  return values;
}

bool one_to_one(const Loop& a, const Loop& b) {
  const auto same_curve = [](const Curve& c, const Curve& d) {
    return c.name == d.name && c.shape.index() == d.shape.index() && c.parameters == d.parameters;
  };
  return a.role == b.role && a.open == b.open &&
         std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(), same_curve);
}

bool one_to_one(const Domain& a, const Domain& b) {
  return std::equal(a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(),
                    [](const Loop& l, const Loop& m) { return one_to_one(l, m); });
}

Frame::Frame(const Placement& placement)
    : axis_(placement.chord * direction(placement.rotation_deg / 360.0)),
      origin_(placement.position),
      identity_(placement == Placement{}) {}

Domain airfoils_domain(const std::vector<PlacedAirfoil>& airfoils, const AirfoilDomainOptions& options) {
  check_options(options);
  Domain domain;
  for (const PlacedAirfoil& airfoil : airfoils)
    domain.loops.push_back(airfoil_loop(airfoil, options.points, options.turning_share.value_or(0.0)));
  const Arc circle{.centre = options.farfield_centre, .radius = options.farfield_radius};
  domain.loops.push_back({.role = LoopRole::outer,
                          .curves = {{.name = "farfield",
                                      .shape = circle,
                                      .parameters = mirrored_fractions(options.farfield_points)}}});
  for (std::size_t loop = 0; loop < airfoils.size(); ++loop)
    check_farfield_contains(domain, loop, airfoils[loop], options);
  return domain;
}

Domain airfoil_domain(const CstAirfoil& airfoil, const AirfoilDomainOptions& options) {
  return airfoils_domain({{.airfoil = airfoil}}, options);
}

}  // namespace remodel
