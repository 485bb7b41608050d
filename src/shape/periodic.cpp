// Which curves of a domain are periodic counterparts, and whether they are.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "remodel/domain.h"
#include "remodel/error.h"
#include "shape/loop_side.h"

namespace remodel {

namespace {

constexpr double tolerance = 1e-9;  // of the coordinates, and of parameters

[[noreturn]] void refuse_pair(const PeriodicPair& pair, const std::string& found) {
  throw Error(ErrorCode::geometry, nameless_domain,
              "the periodic curves \"" + pair.name + "\" and \"" + pair.moved + "\": " + found);
}

// In the order of travel: around a closed loop from one that follows a curve of another name.
std::vector<std::size_t> curves_called(const Domain& domain, const std::string& name) {
  std::vector<std::size_t> curves;
  std::size_t first = 0;
  for (const Loop& loop : domain.loops) {
    const std::size_t n = loop.curves.size();
    std::size_t begin = 0;
    const auto is_called = [&](std::size_t c) { return loop.curves[c % n].name == name; };
    while (!loop.open && begin < n && is_called(begin) && is_called(begin + n - 1)) ++begin;
    for (std::size_t k = 0; k < n; ++k)
      if (is_called(begin + k)) curves.push_back(first + (begin + k) % n);
    first += n;
  }
  return curves;
}

void require_opposite_sides(const Domain& domain, const PeriodicPair& pair, const PeriodicCurve& curve) {
  const auto first = has_domain_on_left(domain, domain.loop_of(curve.curve)),
             moved = has_domain_on_left(domain, domain.loop_of(curve.moved));
  if (!first || !moved) refuse_pair(pair, "found a curve inside the domain, expected two that bound it");
  if ((*first == *moved) != curve.reversed)
    refuse_pair(pair, "found the domain on the same side of both, expected it between them");
}

std::string text_of(Point p) {
  std::ostringstream text;
  text.precision(10);
  text << "(" << p.x << ", " << p.y << ")";
  return text.str();
}

double size_of(Point p) {
  return std::max(std::fabs(p.x), std::fabs(p.y));
}

// Parameters that tell two curves apart: those of the points that one is drawn through, its stations, and
// even ones.
std::vector<double> telling_places(const Curve& curve) {
  constexpr int even = 16;
  std::vector<double> places = curve.parameters.values();
  for (int i = 0; i <= even; ++i) places.push_back(static_cast<double>(i) / even);
  if (const auto* polyline = std::get_if<Polyline>(&curve.shape))
    for (std::size_t i = 0; i < polyline->points.size(); ++i)
      places.push_back(static_cast<double>(i) / static_cast<double>(polyline->points.size() - 1));
  if (const auto* spline = std::get_if<Spline>(&curve.shape))
    places.insert(places.end(), spline->knots.begin(), spline->knots.end());
  return places;
}

void require_moved(const Domain& domain, const PeriodicPair& pair, const PeriodicCurve& curve) {
  std::vector<double> places = telling_places(domain.curve(curve.curve));
  for (const double t : telling_places(domain.curve(curve.moved))) places.push_back(curve.parameter(t));
  for (const double t : places) {
    const Point wanted = domain.at({curve.curve, t}) + curve.period;
    const Point found = domain.at({curve.moved, curve.parameter(t)});
    if (!(size_of(found - wanted) <= tolerance * (size_of(wanted) + size_of(curve.period))))
      refuse_pair(pair, "found " + text_of(found) + ", expected " + text_of(wanted) +
                            ", the first one moved by " + text_of(curve.period));
  }
}

void require_stations(const Domain& domain, const PeriodicPair& pair, const PeriodicCurve& curve) {
  const Parameters &first = domain.curve(curve.curve).parameters,
                   &moved = domain.curve(curve.moved).parameters;
  bool same = first.size() == moved.size();
  for (std::size_t i = 1; same && i < first.size(); ++i) {
    const std::size_t j = curve.reversed ? first.size() - i : i;
    same = std::fabs(curve.parameter(first[i]) - moved[j]) <= tolerance;
  }
  if (!same)
    refuse_pair(pair, "found stations (" + std::to_string(first.size()) + " and " +
                          std::to_string(moved.size()) +
                          ") that do not correspond, expected the same ones on both");
}

}  // namespace

std::vector<PeriodicCurve> periodic_curves(const Domain& domain) {
  std::vector<PeriodicCurve> result;
  for (const PeriodicPair& pair : domain.periodic) {
    const std::vector<std::size_t> first = curves_called(domain, pair.name),
                                   moved = curves_called(domain, pair.moved);
    if (first.empty() || moved.empty())
      refuse_pair(pair, "found no curve \"" + (first.empty() ? pair.name : pair.moved) + "\", expected one");
    if (pair.name == pair.moved) refuse_pair(pair, "found one name twice, expected two");
    if (first.size() != moved.size())
      refuse_pair(pair, "found " + std::to_string(first.size()) + " and " + std::to_string(moved.size()) +
                            " curves of the names, expected as many of either");
    const Point begin = domain.at({first.front(), 0.0}), end = domain.at({first.back(), 1.0});
    const Point moved_begin = domain.at({moved.front(), 0.0}), moved_end = domain.at({moved.back(), 1.0});
    const bool reversed = size_of((moved_end - begin) - (moved_begin - end)) <
                          size_of((moved_begin - begin) - (moved_end - end));
    for (std::size_t i = 0; i < first.size(); ++i) {
      const PeriodicCurve curve{.curve = first[i],
                                .moved = moved[reversed ? first.size() - 1 - i : i],
                                .reversed = reversed,
                                .period = (reversed ? moved_end : moved_begin) - begin};
      require_opposite_sides(domain, pair, curve);
      require_moved(domain, pair, curve);
      require_stations(domain, pair, curve);
      result.push_back(curve);
    }
  }
  return result;
}

}  // namespace remodel
