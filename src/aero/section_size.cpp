// The area of a section or of a part of it, and its thickness at stations or all over a part.

#include <algorithm>
#include <cmath>

#include "aero/loop_size.h"
#include "aero/section_rows.h"

namespace remodel {
namespace {

constexpr Limits any_size = {0.0, 10.0};

DomainConstraintPtr at_least(const DomainRequest& request, std::vector<SectionRow> rows) {
  for (SectionRow& row : rows) row.bound += request.least(any_size, value_of(row, request.start));
  return std::make_shared<SectionRows>(request.section, std::move(rows));
}

// What lies between two stations, `x`, in the direction of the chord.
struct Span {
  double front = 0.0, back = 0.0;
};
Span span_of(const DomainRequest& request) {
  const std::vector<double>& x = stations_of(request);
  if (x.size() != 2 || !(x[0] < x[1]))
    request.place.fail("found " + shown(x) + " as 'x', expected two numbers, the front one first");
  return {x[0], x[1]};
}

// The area between both surfaces from front to back, by the trapezoidal rule in t, which is exact to rounding
// for the whole of these sections, and to 1e-5 of it for a part.
SectionRow area_between(const CstAirfoil& like, Span span) {
  constexpr int pieces = 400;
  const double first = std::acos(2.0 * span.back - 1.0), last = std::acos(2.0 * span.front - 1.0);
  SectionRow sum;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = first + (last - first) * i / pieces, x = 0.5 * (1.0 + std::cos(angle));
    const double width = (i == 0 || i == pieces ? 0.25 : 0.5) * std::sin(angle) * (last - first) / pieces;
    if (!(width > 0.0)) continue;  // an edge, where a section has no height
    add_height(like, x, true, width, sum), add_height(like, x, false, -width, sum);
  }
  return sum;
}

SectionRow thickness_at(const CstAirfoil& like, double x) {
  SectionRow row;
  add_height(like, x, true, 1.0, row), add_height(like, x, false, -1.0, row);
  return row;
}

DomainConstraintPtr area(const DomainRequest& request) {
  return at_least(request, {area_between(request.start, {0.0, 1.0})});
}

DomainConstraintPtr tank(const DomainRequest& request) {
  return at_least(request, {area_between(request.start, span_of(request))});
}

DomainConstraintPtr thickness(const DomainRequest& request) {
  std::vector<SectionRow> rows;
  for (const double x : stations_of(request)) rows.push_back(thickness_at(request.start, x));
  return at_least(request, std::move(rows));
}

// The thickness everywhere from front to back, at stations; a part of the start's is one of its least there.
DomainConstraintPtr box(const DomainRequest& request) {
  constexpr int pieces = 20;
  const Span span = span_of(request);
  std::vector<SectionRow> rows;
  double of_start = 10.0;
  for (int i = 0; i <= pieces; ++i) {
    rows.push_back(thickness_at(request.start, span.front + (span.back - span.front) * i / pieces));
    of_start = std::min(of_start, value_of(rows.back(), request.start));
  }
  for (SectionRow& row : rows) row.bound += request.least(any_size, of_start);
  return std::make_shared<SectionRows>(request.section, std::move(rows));
}

}  // namespace

extern constinit const DomainKind area_kind = {.name = "area", .make = area, .make_of_loop = area_of_loop};
extern constinit const DomainKind tank_kind = {.name = "tank", .takes_x = true, .make = tank};
extern constinit const DomainKind box_kind = {.name = "box", .takes_x = true, .make = box};
extern constinit const DomainKind thickness_kind = {
    .name = "thickness", .takes_x = true, .make = thickness, .make_of_loop = thickness_of_loop};

}  // namespace remodel
