#include "aero/layered_space.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "remodel/error.h"

namespace remodel {
namespace {

std::size_t stations_on_sections(const Domain& domain) {
  std::size_t count = 0;
  for (const Loop& loop : domain.loops)
    if (loop.role == LoopRole::hole)
      for (const Curve& curve : loop.curves) count += curve.parameters.size();
  return count;
}

}  // namespace

LayeredSpace::LayeredSpace(std::unique_ptr<FlowSpace> bodies, const LayerOptions& layer, int points)
    : bodies_(std::move(bodies)),
      points_(points),
      stations_(stations_of(bodies_->domain(bodies_->start()), points)),
      frame_(walls(bodies_->start()), layer) {}

// Distances are halved in on until the sections have as many stations as are asked for, or a few less.
Stations LayeredSpace::stations_of(const Domain& start, int points) {
  const WallSpacing usual;
  constexpr double finest = 0.01, coarsest = 30.0;  // times the usual distances
  constexpr int halvings = 20;
  std::size_t sections = 0;
  for (const Loop& loop : start.loops) sections += loop.role == LoopRole::hole;
  double fine = finest, coarse = coarsest;
  Domain spaced = start;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(fine * coarse);
    space_walls(spaced, usual.times(middle));
    (stations_on_sections(spaced) > sections * static_cast<std::size_t>(points) ? fine : coarse) = middle;
  }
  space_walls(spaced, usual.times(coarse));
  return remodel::stations_of(spaced);
}

Domain LayeredSpace::walls(std::span<const double> design) const {
  return with_stations(bodies_->domain(design), stations_);
}

Domain LayeredSpace::domain_with(std::span<const double> design, int points) const {
  const std::vector<double> start = bodies_->start();
  return with_stations(bodies_->domain(design), stations_of(bodies_->domain(start), points));
}

bool LayeredSpace::feasible(std::span<const double> design) const {
  return bodies_->feasible(design) && FlowSpace::feasible(design);
}

std::string LayeredSpace::description() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(bodies_->description());
  const LayerOptions& layer = frame_.options();
  json["layers"] = {{"points", points_},
                    {"first_height", layer.first_height},
                    {"growth", layer.growth},
                    {"thickness", layer.thickness}};
  return json.dump();
}

std::unique_ptr<FlowSpace> LayeredSpace::from_description(std::unique_ptr<FlowSpace> bodies,
                                                          const std::string& description) {
  const nlohmann::ordered_json layer = nlohmann::ordered_json::parse(description).at("layers");
  return std::make_unique<LayeredSpace>(std::move(bodies),
                                        LayerOptions{.first_height = layer.at("first_height"),
                                                     .growth = layer.at("growth"),
                                                     .thickness = layer.at("thickness")},
                                        layer.at("points").get<int>());
}

}  // namespace remodel
