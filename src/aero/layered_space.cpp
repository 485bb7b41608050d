#include "aero/layered_space.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "layer/walls.h"
#include "remodel/error.h"
#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

// The stations on walls (is_wall()), and how many loops have some.
struct StationCount {
  std::size_t stations = 0, loops = 0;
};
StationCount count_stations(const Domain& domain, const std::vector<std::string>& names) {
  StationCount count;
  for (std::size_t l = 0; l < domain.loops.size(); ++l) {
    const std::size_t before = count.stations;
    const std::vector<Curve>& curves = domain.loops[l].curves;
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (is_wall(domain, l, c, names)) count.stations += curves[c].parameters.size();
    count.loops += count.stations > before;
  }
  return count;
}

}  // namespace

LayeredSpace::LayeredSpace(std::unique_ptr<FlowSpace> bodies, const LayerOptions& layer, int points,
                           const std::optional<WakeLine>& wake)
    : bodies_(std::move(bodies)),
      points_(points),
      stations_(stations_of(bodies_->domain(bodies_->start()), points, layer.walls)),
      wake_(start_wake(this->bodies(bodies_->start()), wake, layer)),
      frame_(walls(bodies_->start()), layer) {}

// The wake's numbers, which are the last ones, follow nothing.
std::vector<double> LayeredSpace::gradient_of_domain(std::span<const double> by_numbers) const {
  const std::size_t of_wake = wake_ ? coefficients_of({{wake_->loop}}).size() : 0;
  return bodies_->gradient_of_domain(by_numbers.first(by_numbers.size() - of_wake));
}

// Distances are halved in on until the walls have as many stations as are asked for, or a few less.
Stations LayeredSpace::stations_of(const Domain& start, int points, const std::vector<std::string>& names) {
  const WallSpacing usual;
  constexpr double finest = 0.01, coarsest = 30.0;  // times the usual distances
  constexpr int halvings = 20;
  const std::size_t wanted = count_stations(start, names).loops * static_cast<std::size_t>(points);
  double fine = finest, coarse = coarsest;
  Domain spaced = start;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(fine * coarse);
    space_walls(spaced, usual.times(middle), names);
    (count_stations(spaced, names).stations > wanted ? fine : coarse) = middle;
  }
  space_walls(spaced, usual.times(coarse), names);
  return remodel::stations_of(spaced);
}

Domain LayeredSpace::domain_with(std::span<const double> design, int points) const {
  const std::vector<double> start = bodies_->start();
  return with_wake(with_stations(bodies_->domain(design),
                                 stations_of(bodies_->domain(start), points, frame_.options().walls)),
                   wake_);
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
  if (!layer.walls.empty()) json["layers"]["walls"] = layer.walls;
  if (wake_) json["layers"]["wake"] = to_json(wake_->line);
  return json.dump();
}

std::unique_ptr<FlowSpace> LayeredSpace::from_description(std::unique_ptr<FlowSpace> bodies,
                                                          const std::string& description) {
  const nlohmann::ordered_json layer = nlohmann::ordered_json::parse(description).at("layers");
  return std::make_unique<LayeredSpace>(
      std::move(bodies),
      LayerOptions{.first_height = layer.at("first_height"),
                   .growth = layer.at("growth"),
                   .thickness = layer.at("thickness"),
                   .walls = layer.value("walls", std::vector<std::string>())},
      layer.at("points").get<int>(), wake_in(layer));
}

}  // namespace remodel
