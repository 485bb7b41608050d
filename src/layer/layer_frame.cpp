// LayerFrame: what the layers of a row of designs have in common, and the first mesh that is made with it.

#include <algorithm>
#include <numeric>
#include <utility>

#include "generate/require_option.h"
#include "layer/heights.h"
#include "layer/layer_parts.h"
#include "layer/outside.h"
#include "remodel/error.h"
#include "remodel/generate.h"

namespace remodel {

namespace {

std::uint32_t levels_of(const LayerOptions& options) {
  const std::uint32_t levels = level_count(options.first_height, options.growth, options.thickness);
  const double reached = options.first_height * geometric_sum(options.growth, levels);
  require_option(reached >= options.thickness * (1.0 - 1e-6), "layer thickness", options.thickness,
                 "one that 1000 cells fill");
  return levels;
}

// A layer counts in the budget of vertices: it takes memory before refinement looks at that.
void require_room_for(const Domain& domain, const LayerOptions& layers, std::uint32_t max_vertices) {
  require_layer_options(layers);
  const std::uint32_t levels = levels_of(layers);
  std::size_t stations = 0;
  for (const LayeredWall& wall : layered_walls(domain, layers)) stations += wall.stations;
  if (stations * (std::size_t{levels} + 1) <= max_vertices) return;
  throw Error(ErrorCode::argument, "layers",
              "found " + std::to_string(stations) + " stations on walls and " + std::to_string(levels) +
                  " cells across the layer, expected at most " + std::to_string(max_vertices) +
                  " points of both");
}

}  // namespace

void require_layer_options(const LayerOptions& options) {
  require_option(options.first_height > 0.0 && options.first_height <= 1e3, "first layer height",
                 options.first_height, "more than 0 and at most 1000 chords");
  require_option(options.growth >= 1.02 && options.growth <= 2.0, "growth", options.growth, "1.02 to 2");
  require_option(options.thickness >= options.first_height && options.thickness <= 1e3, "layer thickness",
                 options.thickness, "at least the first layer's height and at most 1000 chords");
  require_option(options.fan_from_deg >= 10.0 && options.fan_from_deg <= 90.0, "angle of fans",
                 options.fan_from_deg, "10 to 90");
}

LayerFrame::LayerFrame(const Domain& walls, const LayerOptions& options) : options_(options) {
  require_layer_options(options);
  validate(walls);
  const Walls evaluated(walls);
  layered_ = layered_walls(evaluated, options);
  levels_ = levels_of(options);
  fans_ = fans_of(evaluated, layered_, options, {layered_.size(), nullptr});
}

std::shared_ptr<const LayeredMesh::Columns> LayerFrame::columns_at(const Domain& walls) const {
  const Walls evaluated(walls);
  if (layered_walls(evaluated, options_) != layered_)
    throw Error(ErrorCode::argument, "walls",
                "found other loops or stations, expected those that the layer began with");
  auto columns = std::make_shared<LayeredMesh::Columns>();
  columns->layered = layered_, columns->levels = levels_, columns->fans = fans_;
  static_cast<LayerColumns&>(*columns) = columns_of(evaluated, layered_, fans_, options_, levels_);
  for (const ColumnRing& ring : columns->rings) {
    std::vector<std::uint32_t>& ids = columns->ids.emplace_back(ring.size());
    std::iota(ids.begin(), ids.end(), columns->next_id);
    columns->next_id += static_cast<std::uint32_t>(ring.size());
  }
  return columns;
}

Domain LayerFrame::outside(const Domain& walls) const {
  return outside_of(walls, *columns_at(walls), levels_);
}

LayeredMesh LayerFrame::around(const Mesh& outer, const Domain& walls) const {
  LayeredMesh mesh;
  mesh.columns_ = columns_at(walls);
  mesh.outer_ = outer;
  mesh.walls_ = walls;
  mesh.options_ = options_;
  return mesh;
}

LayeredGenerateResult generate_layered(const Domain& domain, const LayerOptions& layers,
                                       const QualityOptions& quality, StepObserver* observer) {
  validate(domain);
  require_room_for(domain, layers, quality.max_vertices);
  const LayerFrame frame(domain, layers);
  const std::shared_ptr<const LayeredMesh::Columns> columns = frame.columns_at(domain);
  GenerateResult outer = generate(outside_of(domain, *columns, columns->levels), quality, observer);
  LayeredGenerateResult result;
  result.stopped = outer.stopped;
  result.small_angles = outer.small_angles, result.exempt_triangles = outer.exempt_triangles;
  result.mesh.outer_ = std::move(outer.mesh);
  result.mesh.walls_ = domain, result.mesh.options_ = layers, result.mesh.columns_ = columns;
  return result;
}

}  // namespace remodel
