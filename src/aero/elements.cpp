// The design space of several sections: which numbers of their domain are variables.

#include <algorithm>

#include "aero/element_space.h"
#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

struct PlacementKey {
  const char* key;
  std::size_t number;  // of the placement's
  double scale;        // unless the problem says another
  std::optional<PlacementRange> DesignElement::*range;
};
// A step of a search that moves a coefficient by 0.02 turns an element by one degree.
constexpr PlacementKey placement_keys[] = {{"chord", 0, 1.0, &DesignElement::chord},
                                           {"rotation_deg", 1, 50.0, &DesignElement::rotation_deg},
                                           {"x", 2, 1.0, &DesignElement::x},
                                           {"y", 3, 1.0, &DesignElement::y}};

void add_coefficients(const DesignElement& element, std::size_t first,
                      std::vector<ElementVariable>& variables) {
  const std::size_t n = element.airfoil.upper.size();
  for (std::size_t i = 0; i < 2 * n; ++i)
    variables.push_back(
        {.name = element.name + (i < n ? ".upper[" : ".lower[") + std::to_string(i < n ? i : i - n) + "]",
         .number = first + i,
         .is_coefficient = true});
}

void add_variables(const DesignElement& element, const ProblemPlace& element_place,
                   const LoopNumbers& numbers, std::span<const double> start,
                   std::vector<ElementVariable>& variables) {
  if (element.coefficients) add_coefficients(element, numbers.curves, variables);
  for (const PlacementKey& of : placement_keys) {
    const std::optional<PlacementRange>& range = element.*of.range;
    if (!range) continue;
    const ProblemPlace place = element_place.inner("variables").inner(of.key);
    const double at = start[numbers.placement + of.number];
    if (!(range->low <= range->high))
      place.fail("found " + shown(std::vector{range->low, range->high}) +
                 " as 'bounds', expected two numbers, the lower one first");
    if (!(at >= range->low && at <= range->high))
      place.fail("found bounds that the start, " + shown(at) + ", is not within");
    if (of.number == 0 && !(range->low > 0.0)) place.fail("found 'bounds' of a chord that is not above 0");
    const double scale = range->scale.value_or(of.scale);
    place.require_number(scale, "scale", {1e-6, 1e6});
    variables.push_back({.name = element.name + "." + of.key,
                         .number = numbers.placement + of.number,
                         .scale = scale,
                         .low = range->low,
                         .high = range->high});
  }
}

// As a section of the domain. Throws where there is one of its name, or it lies where none may.
PlacedAirfoil placed_of(const DesignElement& element, const ProblemPlace& all, const ProblemPlace& place,
                        const std::vector<PlacedAirfoil>& others) {
  const std::string& name = element.name;
  if (name.empty() || name == "farfield" || name == "symmetry")
    all.fail("found '" + name + "' as the name of an element");
  for (const PlacedAirfoil& other : others)
    if (other.name == name) all.fail("found two elements of the name '" + name + "'");
  const ProblemPlace at = place.inner("placement");
  at.require_number(element.placement.chord, "chord", {1e-3, 1e3});
  at.require_number(element.placement.rotation_deg, "rotation_deg", {-180.0, 180.0});
  return {.name = name, .airfoil = element.airfoil, .placement = element.placement};
}

}  // namespace

ElementSpace space_of_elements(const DesignProblem& problem, const ProblemPlace& place) {
  constexpr std::size_t most = 20;
  if (problem.elements.size() > most)
    place.fail("found " + std::to_string(problem.elements.size()) +
               " entries in 'elements', expected at most " + std::to_string(most));
  std::vector<ProblemPlace> places;
  std::vector<PlacedAirfoil> placed;
  for (const DesignElement& element : problem.elements) {
    places.push_back(place.inner("element " + std::to_string(places.size() + 1)));
    placed.push_back(placed_of(element, place, places.back(), placed));
  }
  Domain start;
  try {
    AirfoilDomainOptions discretisation = problem.domain;
    if (!discretisation.turning_share && placed.size() > 1)
      discretisation.turning_share = turning_share_of_elements;
    start = airfoils_domain(placed, discretisation);
    validate(start);
  } catch (const Error& error) {
    place.fail("found 'elements' that make no domain: " + std::string(error.what()));
  }
  const std::vector<double> numbers = coefficients_of(start);
  std::vector<ElementVariable> variables;
  for (std::size_t i = 0; i < placed.size(); ++i)
    add_variables(problem.elements[i], places[i], numbers_of_loop(start, i), numbers, variables);
  if (variables.empty()) place.fail("found no variable of any element, expected one or more");
  return {std::move(start), std::move(variables)};
}

}  // namespace remodel
