#include "aero/kinds.h"

#include <algorithm>

namespace remodel {

extern const FlowKind drag_kind, pressure_drag_kind, friction_drag_kind, lift_kind, lift_over_drag_kind,
    moment_kind, mass_flow_kind, total_pressure_kind, pressure_loss_kind, flow_angle_kind, inverse_kind,
    suction_kind;
extern const DomainKind gap_kind, area_kind, tank_kind, thickness_kind, box_kind, camber_kind, contains_kind,
    trailing_edge_angle_kind, leading_edge_radius_kind;

namespace {

constexpr const FlowKind* all_of_flows[] = {
    &drag_kind,            //
    &pressure_drag_kind,   //
    &friction_drag_kind,   //
    &lift_kind,            //
    &lift_over_drag_kind,  //
    &moment_kind,          //
    &mass_flow_kind,       //
    &total_pressure_kind,  //
    &pressure_loss_kind,   //
    &flow_angle_kind,      //
    &inverse_kind,         //
    &suction_kind,         //
};
constexpr const DomainKind* all_of_domains[] = {
    &gap_kind,                  //
    &area_kind,                 //
    &tank_kind,                 //
    &thickness_kind,            //
    &box_kind,                  //
    &camber_kind,               //
    &contains_kind,             //
    &trailing_edge_angle_kind,  //
    &leading_edge_radius_kind,  //
};

template <class Kind>
const Kind* find_kind(std::span<const Kind* const> kinds, const std::string& name) {
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind* k) { return k->name == name; });
  return found == kinds.end() ? nullptr : *found;
}

}  // namespace

std::span<const FlowKind* const> flow_kinds() {
  return all_of_flows;
}

std::span<const DomainKind* const> domain_kinds() {
  return all_of_domains;
}

const FlowKind* find_flow_kind(const std::string& name) {
  return find_kind(flow_kinds(), name);
}

const DomainKind* find_domain_kind(const std::string& name) {
  return find_kind(domain_kinds(), name);
}

std::vector<std::string> objective_names() {
  std::vector<std::string> names;
  for (const FlowKind* kind : flow_kinds())
    if (kind->objective != 0.0) names.emplace_back(kind->name);
  return names;
}

std::vector<std::string> constraint_kinds() {
  std::vector<std::string> names;
  for (const FlowKind* kind : flow_kinds())
    if (kind->is_constraint()) names.emplace_back(kind->name);
  for (const DomainKind* kind : domain_kinds()) names.emplace_back(kind->name);
  return names;
}

std::size_t element_index(const DesignProblem& problem, const std::string& name, const ProblemPlace& place) {
  for (std::size_t i = 0; i < problem.elements.size(); ++i)
    if (problem.elements[i].name == name) return i;
  place.fail("found '" + name + "', expected the name of an element");
}

std::size_t DomainRequest::element(const std::string& name) const {
  return element_index(problem, name, place);
}

const std::vector<double>& station_list_of(const DomainRequest& request) {
  constexpr std::size_t most_stations = 1000;
  const std::vector<double>& stations = request.place.given(request.given.x, "x");
  if (stations.empty()) request.place.fail("found no number in 'x', expected at least one");
  if (stations.size() > most_stations)
    request.place.fail("found " + std::to_string(stations.size()) + " entries in 'x', expected at most " +
                       std::to_string(most_stations));
  return stations;
}

double DomainRequest::least(Limits limits, double of_start) const {
  if (given.of_start) {
    place.require_number(*given.of_start, "of_start", {0.0, 10.0});
    return *given.of_start * of_start;
  }
  place.require_number(*given.at_least, "at_least", limits);
  return *given.at_least;
}

}  // namespace remodel
