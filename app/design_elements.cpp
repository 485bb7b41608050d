#include "design_elements.h"

#include "remodel/mesh_derivative.h"

namespace remodel::app {

namespace {

struct PlacementKey {
  const char* key;
  std::size_t number;  // of the placement's
  double scale;        // unless the file says another
};
// A step of a search that moves a coefficient by 0.02 turns an element by one degree.
constexpr PlacementKey placement_keys[] = {
    {"chord", 0, 1.0}, {"rotation_deg", 1, 50.0}, {"x", 2, 1.0}, {"y", 3, 1.0}};

Placement placement_of(const Json& json, const std::string& where) {
  const Keys keys(json, where, {"chord", "rotation_deg", "position"});
  Placement placement{.chord = keys.number("chord", 1.0, 1e-3, 1e3),
                      .rotation_deg = keys.number("rotation_deg", 0.0, -180.0, 180.0)};
  const auto position = keys.get<std::vector<double>>("position", std::vector<double>{0.0, 0.0});
  if (position.size() != 2) keys.fail("found " + Json(position).dump() + " as 'position', expected [x, y]");
  placement.position = {position[0], position[1]};
  return placement;
}

struct Element {
  PlacedAirfoil placed;
  Json variables = Json::object();
  std::string where;
};

Element element_of(const Json& entry, const std::string& where, int degree,
                   const std::filesystem::path& directory) {
  const Keys keys(entry, where, {"name", "airfoil", "placement", "variables"});
  Element element{.placed = {.name = keys.get<std::string>("name"),
                             .airfoil = section_named(keys, "airfoil", degree, directory)},
                  .where = where};
  if (keys.has("placement"))
    element.placed.placement = placement_of(entry.at("placement"), where + ", placement");
  if (keys.has("variables")) element.variables = entry.at("variables");
  return element;
}

void add_coefficients(const Element& element, std::size_t first, std::vector<ElementVariable>& variables) {
  const std::size_t n = element.placed.airfoil.upper.size();
  for (std::size_t i = 0; i < 2 * n; ++i)
    variables.push_back({.name = element.placed.name + (i < n ? ".upper[" : ".lower[") +
                                 std::to_string(i < n ? i : i - n) + "]",
                         .number = first + i,
                         .is_coefficient = true});
}

void add_variables(const Element& element, const LoopNumbers& numbers, std::span<const double> start,
                   std::vector<ElementVariable>& variables) {
  const std::string where = element.where + ", variables";
  const Keys keys(element.variables, where, {"coefficients", "chord", "rotation_deg", "x", "y"});
  if (keys.get<bool>("coefficients", false)) add_coefficients(element, numbers.curves, variables);
  for (const PlacementKey& of : placement_keys) {
    if (!keys.has(of.key)) continue;
    const Keys variable(element.variables.at(of.key), where + ", " + of.key, {"bounds", "scale"});
    const auto [low, high] = variable.pair("bounds");
    const double at = start[numbers.placement + of.number];
    if (!(at >= low && at <= high))
      variable.fail("found bounds that the start, " + Json(at).dump() + ", is not within");
    if (of.number == 0 && !(low > 0.0)) variable.fail("found 'bounds' of a chord that is not above 0");
    variables.push_back({.name = element.placed.name + "." + of.key,
                         .number = numbers.placement + of.number,
                         .scale = variable.number("scale", of.scale, 1e-6, 1e6),
                         .low = low,
                         .high = high});
  }
}

}  // namespace

ElementSpace read_elements(const Keys& problem, const std::string& file, int degree,
                           const AirfoilDomainOptions& options) {
  std::vector<Element> elements;
  std::vector<PlacedAirfoil> placed;
  for (const Json& entry : problem.list("elements", 20)) {
    elements.push_back(element_of(entry, file + ", element " + std::to_string(elements.size() + 1), degree,
                                  std::filesystem::path(file).parent_path()));
    const std::string& name = elements.back().placed.name;
    if (name.empty() || name == "farfield" || name == "symmetry")
      problem.fail("found '" + name + "' as the name of an element");
    for (const PlacedAirfoil& other : placed)
      if (other.name == name) problem.fail("found two elements of the name '" + name + "'");
    placed.push_back(elements.back().placed);
  }
  if (placed.empty()) problem.fail("found no element, expected one or more");
  Domain start;
  try {
    start = airfoils_domain(placed, options);
    validate(start);
  } catch (const Error& error) {
    problem.fail("found 'elements' that make no domain: " + std::string(error.what()));
  }
  const std::vector<double> numbers = coefficients_of(start);
  std::vector<ElementVariable> variables;
  for (std::size_t i = 0; i < elements.size(); ++i)
    add_variables(elements[i], numbers_of_loop(start, i), numbers, variables);
  if (variables.empty()) problem.fail("found no variable of any element, expected one or more");
  return {std::move(start), std::move(variables)};
}

}  // namespace remodel::app
