#include "remodel/domain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <sstream>

#include "remodel/error.h"
#include "turn.h"

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
}

// The farfield is a polygon: what it surely contains is its inscribed circle.
void check_farfield_contains(const Domain& domain, std::size_t loop, const AirfoilDomainOptions& options) {
  const double inside = options.farfield_radius * std::cos(std::numbers::pi / options.farfield_points);
  for (const BoundaryStation station : domain.stations(loop)) {
    const Point p = domain.at(station);
    const double distance = std::hypot(p.x - 0.5, p.y);
    if (distance < inside) continue;
    std::ostringstream problem;
    problem << "found " << options.farfield_radius
            << ", expected a farfield that contains the airfoil, which reaches " << distance
            << " chords from (0.5, 0)";
    throw Error(ErrorCode::argument, "farfield radius", problem.str());
  }
}

}  // namespace

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

std::vector<BoundaryStation> Domain::stations(std::size_t loop) const {
  assert(loop < loops.size());
  std::size_t curve_index = 0;
  for (std::size_t l = 0; l < loop; ++l) curve_index += loops[l].curves.size();
  std::vector<BoundaryStation> result;
  for (const Curve& c : loops[loop].curves) {
    for (const double t : c.parameters) result.push_back({curve_index, t});
    ++curve_index;
  }
  return result;
}

double signed_area(const Domain& domain, std::size_t loop) {
  const std::vector<BoundaryStation> stations = domain.stations(loop);
  if (stations.size() < 3) return 0.0;
  const Point origin = domain.at(stations.front());  // relative to a corner: far loops lose no digits
  double twice = 0.0;
  Point previous = domain.at(stations[1]) - origin;
  for (std::size_t i = 2; i < stations.size(); ++i) {
    const Point next = domain.at(stations[i]) - origin;
    twice += cross(previous, next);
    previous = next;
  }
  return 0.5 * twice;
}

bool one_to_one(const Domain& a, const Domain& b) {
  const auto same_curve = [](const Curve& c, const Curve& d) {
    return c.name == d.name && c.shape.index() == d.shape.index() && c.parameters == d.parameters;
  };
  const auto same_loop = [&](const Loop& l, const Loop& m) {
    return l.role == m.role &&
           std::equal(l.curves.begin(), l.curves.end(), m.curves.begin(), m.curves.end(), same_curve);
  };
  return std::equal(a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(), same_loop);
}

Domain airfoil_domain(const CstAirfoil& airfoil, const AirfoilDomainOptions& options) {
  check_options(options);
  expect(airfoil.upper.size() >= 2 && airfoil.upper.size() == airfoil.lower.size(), "airfoil coefficients",
         static_cast<double>(airfoil.lower.size()), "as many lower as upper ones, at least 2");
  Loop body{
      .role = LoopRole::hole,
      .curves = {{.name = "airfoil", .shape = airfoil, .parameters = mirrored_fractions(options.points)}}};
  if (airfoil.te_upper != airfoil.te_lower) {
    const Line trailing_edge{.from = airfoil.at(1.0), .to = airfoil.at(0.0)};
    body.curves.push_back({.name = "airfoil", .shape = trailing_edge, .parameters = {0.0}});
  }
  const Arc circle{.centre = {0.5, 0.0}, .radius = options.farfield_radius};
  const Loop farfield{
      .role = LoopRole::outer,
      .curves = {
          {.name = "farfield", .shape = circle, .parameters = mirrored_fractions(options.farfield_points)}}};
  Domain domain{.loops = {std::move(body), farfield}};
  check_farfield_contains(domain, 0, options);
  return domain;
}

}  // namespace remodel
