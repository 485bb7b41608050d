#pragma once

// Flow equations as what finds flows sees them: searches, steps with older factors, what outlives a mesh. Those of
// FlowSystem have 4 unknowns a vertex, those of FrictionSystem 4 or 5.

#include "flow/linear/augmented.h"
#include "flow/physics/stream.h"
#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// Derivatives by the vertices' coordinates and by what is given of the stream.
struct ShapeSlope {
  std::vector<Point> points;
  double mach = 0.0;
  double length = 0.0;    // of residuals, by the stream's, which the limiter has
  double reynolds = 0.0;  // with friction
};

template <std::size_t N>
class BlockSystem {
 public:
  virtual ~BlockSystem() = default;
  virtual const FlowMesh& mesh() const = 0;
  virtual const Stream& stream() const = 0;

  // What residuals are measured by.
  virtual BlockState<N> undisturbed() const = 0;
  // The flux out of each dual cell. And: lift of the state minus that of the vortex; alpha, or lift, minus the given
  // one. They are not finite where a state is none.
  virtual void residuals(const BlockState<N>& state, BlockVector<N>& of_vertices,
                         Augmented& augmented) const = 0;

  // The pattern of these rows, ascending.
  virtual BlockMatrix<N> pattern(std::vector<std::uint32_t> rows) const = 0;
  BlockMatrix<N> pattern() const;  // of all
  // Derivatives of the residuals of the matrix's rows by the unknowns of vertices.
  virtual void jacobian(const BlockState<N>& state, BlockMatrix<N>& matrix) const = 0;
  // Derivatives of all residuals by the augmented unknowns, and of the augmented equations.
  virtual std::array<BlockVector<N>, augmented_count> augmented_columns(const BlockState<N>& state) const = 0;
  virtual BlockAugmentedRows<N> augmented_rows(const BlockState<N>& state) const = 0;

 protected:
  BlockSystem() = default;
  BlockSystem(const BlockSystem&) = default;
  BlockSystem& operator=(const BlockSystem&) = default;
};

template <std::size_t N>
BlockMatrix<N> BlockSystem<N>::pattern() const {
  std::vector<std::uint32_t> all(mesh().size());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  return pattern(std::move(all));
}

}  // namespace remodel::flow
