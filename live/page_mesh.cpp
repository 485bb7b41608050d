#include "live/page_mesh.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "remodel/error.h"
#include "remodel/flow_layer.h"

namespace remodel {

namespace {

// To three digits: powers differ in their last bit between C libraries, and meshes are not to.
double rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return std::strtod(text.data(), nullptr);
}

// Cells at the wall are higher than layer_for_flow() has them, so that a drag takes no longer and Euler's flow is
// found on the same mesh: y+ 0.3 on a flat plate.
LayerOptions layer_for(double reynolds) {
  LayerOptions layer = layer_for_flow(FlowModel::laminar, reynolds);
  layer.first_height = first_height(0.3, reynolds);
  layer.first_height = rounded(layer.first_height);
  layer.thickness = rounded(layer.thickness);
  return layer;
}

std::size_t stations_on(const Domain& domain, const char* name) {
  std::size_t count = 0;
  for (const Loop& loop : domain.loops)
    for (const Curve& curve : loop.curves)
      if (curve.name == name) count += curve.parameters.size() - 1;
  return count;
}

// At the distances that the program has for layers, all times a factor, so that there are about so many.
Domain spaced(const Domain& domain, int points) {
  constexpr int passes = 4;
  double factor = 280.0 / points;  // that many stations a section has with a factor of 1
  Domain result;
  for (int pass = 0; pass < passes; ++pass) {
    result = domain;
    space_walls(result, WallSpacing{}.times(factor));
    factor *= static_cast<double>(stations_on(result, "airfoil")) / points;
  }
  return result;
}

Domain around(const CstAirfoil& airfoil, int points) {
  if (!surfaces_apart(airfoil))
    throw Error(ErrorCode::geometry, "airfoil", "its upper and its lower side cross, expected them apart");
  return airfoil_domain(airfoil, {.points = points});
}

using Corners = std::array<std::uint64_t, 4>;

// The keys of a cell's corners, ascending; of triangles the last one counts twice.
Corners corners_of(const FrozenMesh& mesh, std::size_t cell) {
  Corners corners{};
  const auto points = mesh.cell(cell);
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = mesh.vertex_keys[points[std::min(i, points.size() - 1)]];
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

PageMesh::PageMesh(const CstAirfoil& airfoil, const PageMeshOptions& options)
    : options_(options), airfoil_(airfoil) {
  const Domain domain = around(airfoil, options.points);
  if (!has_layers()) {
    plain_ = generate(domain, quality()).mesh;
    return;
  }
  const Domain walls = spaced(domain, options.points);
  stations_ = stations_of(walls);
  layered_ = generate_layered(walls, layer_for(options.reynolds), quality()).mesh;
}

Domain PageMesh::domain_of(const CstAirfoil& airfoil) const {
  Domain domain = around(airfoil, options_.points);
  return has_layers() ? with_stations(std::move(domain), stations_) : domain;
}

RemodelResult PageMesh::step(const CstAirfoil& airfoil) {
  const Domain domain = domain_of(airfoil);
  const RemodelOptions how{.strategy = Strategy::renew};
  RemodelResult result = has_layers() ? remodel(layered_, domain, how) : remodel(plain_, domain, how);
  airfoil_ = airfoil;
  return result;
}

FrozenMesh PageMesh::tried(const CstAirfoil& airfoil) {
  const Domain domain = domain_of(airfoil);
  const RemodelOptions how{.strategy = Strategy::renew};
  if (has_layers()) {
    const LayeredTrial trial(layered_, domain, how);
    return layered_.freeze();
  }
  const Trial trial(plain_, domain, how);
  return plain_.freeze();
}

std::vector<std::uint32_t> births_by_corners(const FrozenMesh& before,
                                             const std::vector<std::uint32_t>& births,
                                             const FrozenMesh& after, std::uint32_t step) {
  std::vector<std::pair<Corners, std::uint32_t>> known;
  for (std::size_t cell = 0; cell < before.cell_count(); ++cell)
    known.emplace_back(corners_of(before, cell), births[cell]);
  std::sort(known.begin(), known.end());
  std::vector<std::uint32_t> result;
  for (std::size_t cell = 0; cell < after.cell_count(); ++cell) {
    const Corners corners = corners_of(after, cell);
    const auto at = std::lower_bound(known.begin(), known.end(), std::pair{corners, std::uint32_t{0}});
    result.push_back(at != known.end() && at->first == corners ? at->second : step);
  }
  return result;
}

}  // namespace remodel
