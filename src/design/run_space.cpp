#include "design/run_space.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "remodel/error.h"

namespace remodel {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson to_json(const WallSpacing& spacing) {
  return {{"leading_edge", spacing.leading_edge},
          {"trailing_edge", spacing.trailing_edge},
          {"most", spacing.most},
          {"growth", spacing.growth}};
}

WallSpacing spacing_from(const OrderedJson& json) {
  return {.leading_edge = json.at("leading_edge"),
          .trailing_edge = json.at("trailing_edge"),
          .most = json.at("most"),
          .growth = json.at("growth")};
}

std::unique_ptr<AirfoilSpace> airfoils_of(const CstAirfoil& from, const OptimiseOptions& options) {
  if (!options.start) return std::make_unique<AirfoilSpace>(from, options.domain);
  const MeshStart& start = *options.start;
  return std::make_unique<AirfoilSpace>(from, start.walls ? *start.walls : start.mesh.domain(), start.place);
}

}  // namespace

LayeredAirfoils::LayeredAirfoils(std::unique_ptr<AirfoilSpace> airfoils, const RunLayers& layers)
    : airfoils_(std::move(airfoils)), spacing_(layers.spacing) {
  const std::vector<double> start = airfoils_->start();
  if (spacing_) {
    Domain spaced = airfoils_->domain(start);
    space_walls(spaced, *spacing_, layers.options.walls);
    stations_ = stations_of(spaced);
  }
  wake_ = start_wake(walls(start), layers.wake, layers.options);
  frame_.emplace(walls(start), layers.options);
}

Domain LayeredAirfoils::walls(std::span<const double> design) const {
  Domain domain = airfoils_->domain(design);
  if (spacing_) domain = with_stations(std::move(domain), stations_);
  return with_wake(std::move(domain), wake_);
}

// Two surfaces that are apart at some stations may touch between them, and walls may have no room for a
// layer.
bool LayeredAirfoils::feasible(std::span<const double> design) const {
  return airfoils_->feasible(design) && DesignSpace::feasible(design);
}

std::string LayeredAirfoils::description() const {
  OrderedJson json = OrderedJson::parse(airfoils_->description());
  const LayerOptions& layer = frame_->options();
  json["layers"] = {{"first_height", layer.first_height},
                    {"growth", layer.growth},
                    {"thickness", layer.thickness},
                    {"walls", layer.walls},
                    {"fan_from_deg", layer.fan_from_deg}};
  if (spacing_) json["layers"]["spacing"] = to_json(*spacing_);
  if (wake_) json["layers"]["wake"] = to_json(wake_->line);
  return json.dump();
}

RunSpace::RunSpace(std::unique_ptr<AirfoilSpace> airfoils, const std::optional<RunLayers>& layers)
    : airfoils_(airfoils.get()) {
  if (layers)
    space_ = std::make_unique<LayeredAirfoils>(std::move(airfoils), *layers);
  else
    space_ = std::move(airfoils);
}

RunSpace::RunSpace(const CstAirfoil& from, const OptimiseOptions& options)
    : RunSpace(airfoils_of(from, options), options.layers) {}

std::optional<RunLayers> RunSpace::layers_in(const std::string& options) {
  const OrderedJson json = OrderedJson::parse(options);
  if (!json.contains("layers")) return std::nullopt;
  const OrderedJson& layers = json.at("layers");
  RunLayers result{.options = {.first_height = layers.at("first_height"),
                               .growth = layers.at("growth"),
                               .thickness = layers.at("thickness"),
                               .walls = layers.at("walls").get<std::vector<std::string>>(),
                               .fan_from_deg = layers.at("fan_from_deg")}};
  result.spacing.reset();
  if (layers.contains("spacing")) result.spacing = spacing_from(layers.at("spacing"));
  result.wake = wake_in(layers);
  return result;
}

}  // namespace remodel
