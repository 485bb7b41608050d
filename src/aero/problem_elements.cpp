#include "aero/problem_elements.h"

namespace remodel {

namespace {

Placement placement_of(const Json& json, const std::string& where) {
  const Keys keys(json, where, {"chord", "rotation_deg", "position"});
  Placement placement{.chord = keys.get<double>("chord", 1.0),
                      .rotation_deg = keys.get<double>("rotation_deg", 0.0)};
  const auto position = keys.get<std::vector<double>>("position", std::vector<double>{0.0, 0.0});
  if (position.size() != 2) keys.fail("found " + Json(position).dump() + " as 'position', expected [x, y]");
  placement.position = {position[0], position[1]};
  return placement;
}

std::optional<PlacementRange> range_of(const Keys& variables, const Json& json, const std::string& where,
                                       const char* key) {
  if (!variables.has(key)) return std::nullopt;
  const Keys keys(json.at(key), where + ", " + key, {"bounds", "scale"});
  const auto [low, high] = keys.pair("bounds");
  return PlacementRange{.low = low, .high = high, .scale = keys.find<double>("scale")};
}

void read_variables(const Json& json, const std::string& where, DesignElement& element) {
  const Keys keys(json, where, {"coefficients", "chord", "rotation_deg", "x", "y"});
  element.coefficients = keys.get<bool>("coefficients", false);
  element.chord = range_of(keys, json, where, "chord");
  element.rotation_deg = range_of(keys, json, where, "rotation_deg");
  element.x = range_of(keys, json, where, "x");
  element.y = range_of(keys, json, where, "y");
}

DesignElement element_of(const Json& entry, const std::string& where, const std::optional<int>& degree,
                         const std::filesystem::path& directory, std::vector<std::string>& warnings) {
  const Keys keys(entry, where, {"name", "airfoil", "placement", "variables"});
  DesignElement element{.name = keys.get<std::string>("name"), .airfoil = {}};
  if (keys.has("placement")) element.placement = placement_of(entry.at("placement"), where + ", placement");
  if (keys.has("variables")) read_variables(entry.at("variables"), where + ", variables", element);
  element.airfoil = element.coefficients
                        ? start_named(keys, "airfoil", degree, usual_degree, directory, warnings)
                        : section_named(keys, "airfoil", degree.value_or(usual_degree), directory, warnings);
  return element;
}

}  // namespace

std::vector<DesignElement> read_elements(const Keys& problem, const std::string& file,
                                         const std::optional<int>& degree,
                                         std::vector<std::string>& warnings) {
  std::vector<DesignElement> elements;
  for (const Json& entry : problem.list("elements", 20))
    elements.push_back(element_of(entry, file + ", element " + std::to_string(elements.size() + 1), degree,
                                  std::filesystem::path(file).parent_path(), warnings));
  if (elements.empty()) problem.fail("found no element, expected one or more");
  return elements;
}

}  // namespace remodel
