// The area of a section, and its thickness at stations.

#include <cmath>

#include "aero/section_rows.h"

namespace remodel {
namespace {

constexpr Limits any_size = {0.0, 10.0};
constexpr std::size_t most_stations = 1000;

DomainConstraintPtr at_least(const DomainRequest& request, std::vector<SectionRow> rows) {
  for (SectionRow& row : rows) row.bound += request.least(any_size, value_of(row, request.start));
  return std::make_shared<SectionRows>(request.section, std::move(rows));
}

// The area between both surfaces by the trapezoidal rule in t, which is exact to rounding for these sections.
DomainConstraintPtr area(const DomainRequest& request) {
  constexpr int pieces = 400;
  SectionRow sum;
  for (int i = 1; i < pieces; ++i) {
    const double angle = M_PI * i / pieces, x = 0.5 * (1.0 + std::cos(angle));
    const double width = 0.5 * std::sin(angle) * M_PI / pieces;
    add_height(request.start, x, true, width, sum), add_height(request.start, x, false, -width, sum);
  }
  return at_least(request, {sum});
}

DomainConstraintPtr thickness(const DomainRequest& request) {
  const std::vector<double>& stations = request.place.given(request.given.x, "x");
  if (stations.empty()) request.place.fail("found no number in 'x', expected at least one");
  if (stations.size() > most_stations)
    request.place.fail("found " + std::to_string(stations.size()) + " entries in 'x', expected at most " +
                       std::to_string(most_stations));
  std::vector<SectionRow> rows;
  for (const double x : stations) {
    if (!(x > 0.0 && x < 1.0))
      request.place.fail("found " + shown(x) + " in 'x', expected numbers above 0 and below 1");
    rows.emplace_back();
    add_height(request.start, x, true, 1.0, rows.back());
    add_height(request.start, x, false, -1.0, rows.back());
  }
  return at_least(request, std::move(rows));
}

}  // namespace

extern constinit const DomainKind area_kind = {.name = "area", .make = area};
extern constinit const DomainKind thickness_kind = {.name = "thickness", .takes_x = true, .make = thickness};

}  // namespace remodel
