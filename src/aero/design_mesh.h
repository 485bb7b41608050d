#pragma once

// The mesh of a design as its flows see it: with the layers on its walls, where the space has some.

#include <optional>
#include <span>
#include <vector>

#include "remodel/flow.h"
#include "remodel/flow_space.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"
#include "remodel/mesh_derivative.h"

namespace remodel {

class DesignMesh {
 public:
  // `mesh` is one of space.domain(design), and outlives this.
  DesignMesh(const FlowSpace& space, const Mesh& mesh, std::span<const double> design);
  // The same of walls that are of no design, like the space's walls(). Throws Error as LayerFrame does.
  DesignMesh(const FlowSpace& space, const Mesh& mesh, const Domain& walls);

  const FrozenMesh& frozen() const { return frozen_; }
  const Domain& walls() const { return layered_ ? layered_->domain() : mesh_.domain(); }
  FlowResult solve(LivingFlow& flow, const FlowConditions& conditions) const {
    return layered_ ? flow.solve(frozen_, conditions) : flow.solve(mesh_, conditions);
  }

 private:
  friend class DesignDerivative;

  const Mesh& mesh_;
  std::optional<LayeredMesh> layered_;
  FrozenMesh frozen_;
};

// Its derivative by the design, with the interior along with the loops that designs move: that of the meshes
// of one reference.
class DesignDerivative {
 public:
  DesignDerivative(const FlowSpace& space, const DesignMesh& mesh);
  // Of derivatives by the points of mesh.frozen().
  std::vector<double> vjp(std::span<const Point> by_points) const;

 private:
  const FlowSpace& space_;
  std::optional<MeshDerivative> plain_;
  std::optional<LayeredMeshDerivative> layered_;
};

}  // namespace remodel
