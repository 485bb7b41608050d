// The angle of a section's trailing edge and the radius of its leading edge, as linear constraints of what
// they follow from. Source: B. Kulfan, "Universal Parametric Geometry Representation Method", 2008.

#include <cmath>

#include "aero/section_rows.h"

namespace remodel {
namespace {

void require_class(const DomainRequest& request) {
  if (request.start.e1 != 0.5 || request.start.e2 != 1.0)
    request.place.fail(
        "found an airfoil of another class, expected one that is round in front and sharp behind");
}

// Of a start that has none there is no part.
void require_start_has(const DomainRequest& request, double value, const char* what) {
  if (request.given.of_start && !(value > 0.0))
    request.place.fail("found 'of_start' of " + std::string(what) +
                       " that the start has not, expected at_least");
}

// The difference of both surfaces' slopes at the trailing edge, of what points behind it: there (e2 = 1) a
// surface falls by its last coefficient.
DomainConstraintPtr trailing_edge_angle(const DomainRequest& request) {
  require_class(request);
  const CstAirfoil& start = request.start;
  const std::size_t n = start.upper.size();
  SectionRow slopes{.row = std::vector<double>(2 * n, 0.0), .bound = start.te_upper - start.te_lower};
  slopes.row[n - 1] = 1.0, slopes.row[2 * n - 1] = -1.0;
  const double of_start = value_of(slopes, start);
  require_start_has(request, of_start, "an angle");
  double least = 0.0;
  if (request.given.of_start) {
    const double half = request.least({}, std::atan(0.5 * of_start));
    if (half > 0.25 * M_PI)
      request.place.fail("found an 'of_start' that is " + shown(half * 360.0 / M_PI) +
                         " degrees, expected 90 at most");
    least = 2.0 * std::tan(half);
  } else {
    least = 2.0 * std::tan(request.least({0.0, 90.0}, 0.0) * M_PI / 360.0);
  }
  slopes.bound += least;
  return std::make_shared<SectionRows>(request.section, std::vector{std::move(slopes)});
}

// The root of twice a surface's radius of curvature at the leading edge (e1 = 1/2): its first coefficient.
DomainConstraintPtr leading_edge_radius(const DomainRequest& request) {
  require_class(request);
  const std::size_t n = request.start.upper.size();
  std::vector<SectionRow> roots;
  for (const bool upper : {true, false}) {
    if (request.symmetric && !upper) continue;
    SectionRow root{.row = std::vector<double>(2 * n, 0.0), .bound = 0.0};
    root.row[upper ? 0 : n] = upper ? 1.0 : -1.0;
    const double of_start = value_of(root, request.start);
    require_start_has(request, of_start, "a radius");
    // The part of a radius is not that of its root.
    root.bound += request.given.of_start ? std::sqrt(request.least({}, 1.0)) * of_start
                                         : std::sqrt(2.0 * request.least({0.0, 1.0}, 0.0));
    roots.push_back(std::move(root));
  }
  return std::make_shared<SectionRows>(request.section, std::move(roots));
}

}  // namespace

extern constinit const DomainKind trailing_edge_angle_kind = {.name = "trailing_edge_angle",
                                                              .make = trailing_edge_angle};
extern constinit const DomainKind leading_edge_radius_kind = {.name = "leading_edge_radius",
                                                              .make = leading_edge_radius};

}  // namespace remodel
