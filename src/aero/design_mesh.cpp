#include "aero/design_mesh.h"

#include <algorithm>

namespace remodel {
namespace {

std::optional<LayeredMesh> with_layers(const FlowSpace& space, const Mesh& mesh, const Domain& walls) {
  if (space.layers() == nullptr) return std::nullopt;
  return space.layers()->around(mesh, walls);
}

// The loops of a domain that depend on the design.
std::vector<std::size_t> moving_loops(const FlowSpace& space, const Domain& walls) {
  std::vector<std::size_t> moving;
  std::vector<double> unit(coefficients_of(walls).size(), 0.0);
  std::size_t first = 0;
  for (std::size_t l = 0; l < walls.loops.size(); ++l) {
    const std::size_t count = coefficients_of(Domain{{walls.loops[l]}}).size();
    bool moves = false;
    for (std::size_t i = first; i < first + count && !moves; ++i) {
      unit[i] = 1.0;
      const std::vector<double> by = space.gradient_of_domain(unit);
      moves = std::any_of(by.begin(), by.end(), [](double x) { return x != 0.0; });
      unit[i] = 0.0;
    }
    if (moves) moving.push_back(l);
    first += count;
  }
  return moving;
}

}  // namespace

DesignMesh::DesignMesh(const FlowSpace& space, const Mesh& mesh, std::span<const double> design)
    : DesignMesh(space, mesh, space.layers() == nullptr ? Domain() : space.walls(design)) {}

DesignMesh::DesignMesh(const FlowSpace& space, const Mesh& mesh, const Domain& walls)
    : mesh_(mesh),
      layered_(with_layers(space, mesh, walls)),
      frozen_(layered_ ? layered_->freeze() : mesh.freeze()) {}

DesignDerivative::DesignDerivative(const FlowSpace& space, const DesignMesh& mesh) : space_(space) {
  const std::vector<std::size_t> moving = moving_loops(space, mesh.walls());
  if (mesh.layered_)
    layered_.emplace(*mesh.layered_, moving);
  else
    plain_.emplace(mesh.mesh_, moving);
}

std::vector<double> DesignDerivative::vjp(std::span<const Point> by_points) const {
  return space_.gradient_of_domain(layered_ ? layered_->vjp(by_points) : plain_->vjp(by_points));
}

}  // namespace remodel
