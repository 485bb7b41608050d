#pragma once

// A steady flow on a median dual, as equations: residual, exact Jacobian, derivatives by the shape. Unknowns
// are those of physics/state.h at each vertex and two augmented ones, the lift coefficient that the vortex in
// the far field belongs to and the angle of attack.
//
// The scheme: the terms (terms.h) of faces between dual cells, from states and gradients at both ends, where
// the gradient at a vertex is the area-weighted mean of those of the cells around it; boundary conditions
// (physics/boundary/patch.h), weakly, at each half of a boundary edge.

#include <array>
#include <span>
#include <vector>

#include "flow/scheme/block_system.h"
#include "flow/scheme/boundary_inputs.h"
#include "flow/scheme/flow_mesh.h"
#include "flow/scheme/terms.h"

namespace remodel::flow {

class FlowSystem final : public BlockSystem<unknown_count> {
 public:
  FlowSystem(const FlowMesh& mesh, const Stream& stream)
      : mesh_(mesh), stream_(stream), terms_(terms_of(stream)) {}

  const FlowMesh& mesh() const override { return mesh_; }
  const Stream& stream() const override { return stream_; }
  State undisturbed() const override;

  // The flux out of each dual cell. It is not finite where a state is none.
  void residual(const State& state, Vector& out) const;
  Augmented augmented_residual(const State& state) const;
  void residuals(const State& state, Vector& of_vertices, Augmented& augmented) const override {
    residual(state, of_vertices);
    augmented = augmented_residual(state);
  }

  // Each row has the vertices of its two rings and itself.
  using BlockSystem::pattern;
  BlockRows pattern(std::vector<std::uint32_t> rows) const override;
  // `faces` gets the derivatives of all fluxes that it takes, by edge.
  void jacobian(const State& state, BlockRows& matrix, std::vector<FaceDerivative>* faces) const;
  void jacobian(const State& state, BlockRows& matrix) const override { jacobian(state, matrix, nullptr); }
  std::array<Vector, augmented_count> augmented_columns(const State& state) const override;
  AugmentedRows augmented_rows(const State& state) const override;

  // The derivative, at this state, of the sum over vertices of weight times residual, for each row of
  // weights: fluxes are differentiated once. faces: of the whole Jacobian at this state, or empty.
  std::vector<ShapeSlope> residual_slopes(const State& state, std::span<const Vector> weights,
                                          std::span<const FaceDerivative> faces = {}) const;

  // Sum over dual faces of the speed of waves times length: what a time step is bounded by.
  std::vector<double> wave_speeds(const State& state) const;
  // Into the domain, through each patch; 0 where it is solid.
  std::vector<double> mass_flows(const State& state) const;

  // What a term sees of the half of a boundary edge at its first (0) or second end.
  template <class T>
  BoundaryInputs<T> boundary_inputs(const State& state, const BoundaryEdge& edge, std::size_t half) const;

 private:
  std::vector<Unknowns<Point>> gradients(const State& state) const;
  // gradients: of all vertices, or empty; then they are summed up for this edge alone.
  FaceInputs<double, double> face_inputs(const State& state, const DualEdge& edge,
                                         std::span<const Unknowns<Point>> gradients = {}) const;
  void add_boundary_blocks(const State& state, BlockRows& matrix,
                           std::span<const std::uint32_t> row_of) const;
  void add_boundary_slopes(const State& state, const Vector& weight, FlowMesh::Slopes& slopes,
                           ShapeSlope& result) const;

  const FlowMesh& mesh_;
  Stream stream_;
  FaceTerms terms_;
};

template <class T>
BoundaryInputs<T> FlowSystem::boundary_inputs(const State& state, const BoundaryEdge& edge,
                                              std::size_t half) const {
  const auto gas = [&](std::uint32_t v) -> const Unknowns<double>& { return state.q[v]; };
  return boundary_inputs_of<T>(mesh_, stream_, state.augmented, edge, half, gas);
}

}  // namespace remodel::flow
