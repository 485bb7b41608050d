// LayeredMeshDerivative: columns by differences, what lies beyond their tops by the outer mesh's own
// derivative.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "layer/layer_parts.h"
#include "layer/outside.h"
#include "remodel/error.h"

namespace remodel {

namespace {

// The points of a layer in the order of the frozen view, and the numbers of the domain beyond it.
struct Places {
  std::vector<Point> layer;
  std::vector<double> outside;
};

Places places_at(const Domain& walls, const std::vector<LayeredWall>& layered, const FanSectors& fans,
                 const LayerOptions& options, std::uint32_t levels) {
  const LayerColumns columns = columns_of(Walls(walls), layered, fans, options, levels);
  Places places;
  for (const ColumnRing& ring : columns.rings)
    for (std::size_t c = 0; c < ring.size(); ++c) {
      if (c == 0 || ring.station[c] != ring.station[c - 1]) places.layer.push_back(ring.foot[c]);
      for (std::uint32_t level = 0; level < levels; ++level)
        places.layer.push_back(ring.points[c * levels + level]);
    }
  places.outside = coefficients_of(outside_of(walls, columns, levels));
  return places;
}

double shortest_spacing(const Domain& walls, const std::vector<LayeredWall>& layered) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const LayeredWall& wall : layered) {
    const std::vector<Point> points = walls.points(wall.loop);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      shortest = std::min(shortest, squared_distance(points[i], points[i + 1]));
  }
  return std::sqrt(shortest);
}

// How far each coefficient goes for a difference. Those of sections and placements are in chords or near 1,
// or degrees, and move all stations smoothly. A point that a curve goes through moves the stations beside it
// alone, and turns what is between them by its move over their distance: the sum over a smooth move of many
// points is far less than its parts.
std::vector<double> steps_of(const Domain& walls, double spacing) {
  constexpr double smooth = 1e-4, part_of_spacing = 1e-3;
  constexpr std::size_t of_placement = 4;
  std::vector<double> steps;
  for (const Loop& loop : walls.loops) {
    for (const Curve& curve : loop.curves)
      steps.insert(steps.end(), coefficients_of(Domain{{Loop{.curves = {curve}}}}).size() - of_placement,
                   std::holds_alternative<CstAirfoil>(curve.shape)
                       ? smooth
                       : std::min(smooth, part_of_spacing * spacing));
    steps.insert(steps.end(), of_placement, smooth);
  }
  return steps;
}

void require_size(std::size_t found, std::size_t expected, const char* what) {
  if (found == expected) return;
  throw Error(ErrorCode::argument, what,
              "found " + std::to_string(found) + " numbers, expected " + std::to_string(expected));
}

}  // namespace

LayeredMeshDerivative::LayeredMeshDerivative(const LayeredMesh& mesh)
    : LayeredMeshDerivative(mesh, MeshDerivative(mesh.outer())) {}

LayeredMeshDerivative::LayeredMeshDerivative(const LayeredMesh& mesh, std::span<const std::size_t> moving)
    : LayeredMeshDerivative(mesh, MeshDerivative(mesh.outer(), moving)) {}

LayeredMeshDerivative::LayeredMeshDerivative(const LayeredMesh& mesh, const MeshDerivative& beyond) {
  const LayeredMesh::Columns& columns = *mesh.columns_;
  const FrozenMesh outside = mesh.outer().freeze();
  // The tops are points of the layer; all others of the outer mesh follow these.
  std::vector<bool> is_top(outside.points.size(), false);
  for (const RingTops& ring : tops_of(mesh.outer(), columns))
    for (const VertexId top : ring.top) {
      const auto at = std::lower_bound(outside.vertex_ids.begin(), outside.vertex_ids.end(), top.index);
      is_top[static_cast<std::size_t>(at - outside.vertex_ids.begin())] = true;
    }
  const std::vector<double> own = coefficients_of(mesh.domain());
  const std::vector<double> steps = steps_of(mesh.domain(), shortest_spacing(mesh.domain(), columns.layered));
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double step = steps[i];
    Places sum;
    for (const auto& [times, factor] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      std::vector<double> coefficients = own;
      coefficients[i] += times * step;
      const Places at = places_at(with_coefficients(mesh.domain(), coefficients), columns.layered,
                                  columns.fans, mesh.options(), columns.levels);
      sum.layer.resize(at.layer.size()), sum.outside.resize(at.outside.size());
      const double by = factor / (12.0 * step);
      for (std::size_t v = 0; v < at.layer.size(); ++v) sum.layer[v] = sum.layer[v] + by * at.layer[v];
      for (std::size_t z = 0; z < at.outside.size(); ++z) sum.outside[z] += by * at.outside[z];
    }
    const std::vector<Point> outer = beyond.jvp(sum.outside);
    std::vector<Point>& moved = moved_.emplace_back(std::move(sum.layer));
    for (std::size_t v = 0; v < outer.size(); ++v)
      if (!is_top[v]) moved.push_back(outer[v]);
    points_ = moved.size();
  }
}

std::vector<Point> LayeredMeshDerivative::jvp(std::span<const double> direction) const {
  require_size(direction.size(), moved_.size(), "direction");
  std::vector<Point> result(points_);
  for (std::size_t i = 0; i < moved_.size(); ++i)
    for (std::size_t v = 0; v < points_; ++v) result[v] = result[v] + direction[i] * moved_[i][v];
  return result;
}

std::vector<double> LayeredMeshDerivative::vjp(std::span<const Point> by_points) const {
  require_size(by_points.size(), points_, "derivatives by points");
  std::vector<double> result;
  for (const std::vector<Point>& moved : moved_) {
    double sum = 0.0;
    for (std::size_t v = 0; v < points_; ++v) sum += dot(by_points[v], moved[v]);
    result.push_back(sum);
  }
  return result;
}

}  // namespace remodel
