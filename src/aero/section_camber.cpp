// The camber of a section at stations.

#include "aero/section_rows.h"

namespace remodel {
namespace {

constexpr Limits any_camber = {-1.0, 1.0};

DomainConstraintPtr camber(const DomainRequest& request) {
  if (!request.given.at_least && !request.given.at_most)
    request.place.fail("found neither 'at_least' nor 'at_most', expected one of them or both");
  std::vector<SectionRow> rows;
  const auto add = [&](double x, double sign, const std::optional<double>& limit, const char* key) {
    if (!limit) return;
    request.place.require_number(*limit, key, any_camber);
    SectionRow& row = rows.emplace_back();
    for (const bool upper : {true, false}) add_height(request.start, x, upper, 0.5 * sign, row);
    row.bound += sign * *limit;
  };
  for (const double x : stations_of(request)) {
    add(x, 1.0, request.given.at_least, "at_least");
    add(x, -1.0, request.given.at_most, "at_most");
  }
  return std::make_shared<SectionRows>(request.section, std::move(rows));
}

}  // namespace

extern constinit const DomainKind camber_kind = {
    .name = "camber", .takes_start = false, .takes_most = true, .takes_x = true, .make = camber};

}  // namespace remodel
