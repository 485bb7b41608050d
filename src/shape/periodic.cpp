// Which curves of a domain are periodic counterparts, and whether they are.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "remodel/domain.h"
#include "remodel/error.h"

namespace remodel {

namespace {

constexpr double tolerance = 1e-9;  // of the coordinates, and of parameters

[[noreturn]] void refuse(const PeriodicPair& pair, const std::string& found) {
  throw Error(ErrorCode::geometry, nameless_domain,
              "the periodic curves \"" + pair.name + "\" and \"" + pair.moved + "\": " + found);
}

std::vector<std::size_t> curves_called(const Domain& domain, const std::string& name) {
  std::vector<std::size_t> curves;
  for (std::size_t c = 0; c < domain.curve_count(); ++c)
    if (domain.curve(c).name == name) curves.push_back(c);
  return curves;
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

void require_moved(const Domain& domain, const PeriodicPair& pair, const PeriodicCurve& curve) {
  constexpr int places = 16;
  for (int i = 0; i <= places; ++i) {
    const double t = static_cast<double>(i) / places;
    const Point wanted = domain.at({curve.curve, t}) + curve.period;
    const Point found = domain.at({curve.moved, curve.parameter(t)});
    if (!(size_of(found - wanted) <= tolerance * (size_of(wanted) + size_of(curve.period))))
      refuse(pair, "found " + text_of(found) + ", expected " + text_of(wanted) + ", the first one moved by " +
                       text_of(curve.period));
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
    refuse(pair, "found stations (" + std::to_string(first.size()) + " and " + std::to_string(moved.size()) +
                     ") that do not correspond, expected the same ones on both");
}

}  // namespace

std::vector<PeriodicCurve> periodic_curves(const Domain& domain) {
  std::vector<PeriodicCurve> result;
  for (const PeriodicPair& pair : domain.periodic) {
    const std::vector<std::size_t> first = curves_called(domain, pair.name),
                                   moved = curves_called(domain, pair.moved);
    if (first.empty() || moved.empty())
      refuse(pair, "found no curve \"" + (first.empty() ? pair.name : pair.moved) + "\", expected one");
    if (first.size() != moved.size() || pair.name == pair.moved)
      refuse(pair, "found " + std::to_string(first.size()) + " and " + std::to_string(moved.size()) +
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
      require_moved(domain, pair, curve);
      require_stations(domain, pair, curve);
      result.push_back(curve);
    }
  }
  return result;
}

}  // namespace remodel
