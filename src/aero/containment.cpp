// A section that contains another one, at stations of each surface.

#include <cmath>

#include "aero/section_rows.h"

namespace remodel {
namespace {

constexpr int containment_stations = 39;  // of a surface

double height(const CstAirfoil& airfoil, double x, bool upper) {
  const double t = parameter_at(x);
  return airfoil.at(upper ? t : 1.0 - t).y;
}

DomainConstraintPtr contains(const DomainRequest& request) {
  const CstAirfoil& inner = request.place.given(request.given.airfoil, "airfoil");
  std::vector<SectionRow> rows;
  constexpr int pieces = containment_stations + 1;
  for (int i = 1; i < pieces; ++i)
    for (const bool upper : {true, false}) {
      if (request.symmetric && !upper) continue;
      const double x = 0.5 * (1.0 + std::cos(M_PI * i / pieces)), sign = upper ? 1.0 : -1.0;
      rows.push_back({.row = {}, .bound = sign * height(inner, x, upper)});
      add_height(request.start, x, upper, sign, rows.back());
    }
  return std::make_shared<SectionRows>(request.section, std::move(rows));
}

}  // namespace

extern constinit const DomainKind contains_kind = {
    .name = "contains", .takes_least = false, .takes_start = false, .takes_airfoil = true, .make = contains};

}  // namespace remodel
