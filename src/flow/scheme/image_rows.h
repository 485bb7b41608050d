#pragma once

// The equations of images (periodic.h): that their unknowns are those of their originals. Linear solvers and
// the adjoint see them as rows like any other.

#include "flow/linear/block_matrix.h"
#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

template <class T>
void copy_to_images(const FlowMesh& mesh, std::vector<T>& values) {
  for (std::uint32_t v = 0; mesh.has_images() && v < values.size(); ++v) values[v] = values[mesh.original(v)];
}

template <std::size_t N>
void set_image_rows(const FlowMesh& mesh, const BlockVector<N>& state, BlockVector<N>& residual) {
  for (std::uint32_t v = 0; mesh.has_images() && v < state.size(); ++v)
    for (std::size_t k = 0; mesh.is_image(v) && k < N; ++k)
      residual[v][k] = state[v][k] - state[mesh.original(v)][k];
}

template <std::size_t N>
void set_image_rows(const FlowMesh& mesh, BlockMatrix<N>& matrix) {
  for (std::uint32_t r = 0; mesh.has_images() && r < matrix.rows.size(); ++r) {
    const std::uint32_t v = matrix.rows[r];
    if (!mesh.is_image(v)) continue;
    for (std::size_t k = 0; k < N; ++k) {
      matrix.at(r, v)[(N + 1) * k] = 1.0;
      matrix.at(r, mesh.original(v))[(N + 1) * k] = -1.0;
    }
  }
}

}  // namespace remodel::flow
