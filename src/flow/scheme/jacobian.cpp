// The driver that differentiates all terms by the unknowns.

#include <algorithm>

#include "flow/scheme/flow_system.h"
#include "flow/scheme/forces.h"
#include "flow/scheme/image_rows.h"

namespace remodel::flow {

BlockRows FlowSystem::pattern(std::vector<std::uint32_t> rows) const {
  BlockRows matrix;
  matrix.rows = std::move(rows);
  matrix.start.assign(1, 0);
  std::vector<std::uint32_t> seen(mesh_.size(), 0), columns;
  for (std::uint32_t r = 0; r < matrix.rows.size(); ++r) {
    columns.clear();
    const auto note = [&](std::uint32_t v) {
      if (seen[v] == r + 1) return;
      seen[v] = r + 1;
      columns.push_back(v);
    };
    note(matrix.rows[r]);
    note(mesh_.counterpart(matrix.rows[r]));  // either way: the pattern is symmetric
    for (const RingEntry& first : mesh_.ring(matrix.rows[r])) {
      note(first.vertex);
      for (const RingEntry& second : mesh_.ring(first.vertex)) note(second.vertex);
    }
    std::sort(columns.begin(), columns.end());
    matrix.column.insert(matrix.column.end(), columns.begin(), columns.end());
    matrix.start.push_back(static_cast<std::uint32_t>(matrix.column.size()));
  }
  matrix.block.resize(matrix.column.size());
  return matrix;
}

// A row's flux depends, by the chain rule, on the states and gradients at both ends of each of its edges, and
// gradients on the rings of these.
void FlowSystem::jacobian(const State& state, BlockRows& matrix, std::vector<FaceDerivative>* faces) const {
  std::fill(matrix.block.begin(), matrix.block.end(), Block{});
  std::vector<FaceDerivative> own, &derivatives = faces != nullptr ? *faces : own;
  derivatives.reserve(matrix.rows.size() == mesh_.size() ? mesh_.edges().size() : 0);
  if (faces != nullptr) faces->resize(mesh_.edges().size());
  std::vector<std::uint32_t> derivative_at(mesh_.edges().size(), no_index);
  const auto derivative = [&](std::uint32_t e) -> const FaceDerivative& {
    if (derivative_at[e] != no_index) return derivatives[derivative_at[e]];
    derivative_at[e] = faces != nullptr ? e : static_cast<std::uint32_t>(derivatives.size());
    if (faces == nullptr) derivatives.emplace_back();
    return derivatives[derivative_at[e]] = derivative_of(terms_, face_inputs(state, mesh_.edges()[e]));
  };
  const auto add = [](Block& to, double factor, const Block& what) {
    for (std::size_t z = 0; z < what.size(); ++z) to[z] += factor * what[z];
  };

  std::vector<std::uint32_t> place(mesh_.size()), row_of(mesh_.size(), no_index);
  for (std::uint32_t r = 0; r < matrix.rows.size(); ++r) {
    const std::uint32_t here = matrix.rows[r];
    row_of[here] = r;
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) place[matrix.column[i]] = i;
    for (const RingEntry& entry : mesh_.ring(here)) {
      const FaceDerivative& flux = derivative(entry.edge);
      const DualEdge& edge = mesh_.edges()[entry.edge];
      const double sign = here == edge.a ? 1.0 : -1.0;
      const Point d = mesh_.vector(edge);
      add(matrix.block[place[edge.a]], sign, flux.by_state[0]);
      add(matrix.block[place[edge.b]], sign, flux.by_state[1]);
      const std::array<std::uint32_t, 2> source = gradient_sources(mesh_, edge);
      for (std::size_t side = 0; side < 2; ++side) {
        double total = 0.0;
        for (const RingEntry& around : mesh_.ring(source[side])) {
          const double w = sign * dot(around.weight, d);
          total += w;
          add(matrix.block[place[around.vertex]], w, flux.by_along[side]);
        }
        add(matrix.block[place[source[side]]], -total, flux.by_along[side]);
      }
    }
  }
  add_boundary_blocks(state, matrix, row_of);
  set_image_rows(mesh_, matrix);
}

void FlowSystem::add_boundary_blocks(const State& state, BlockRows& matrix,
                                     std::span<const std::uint32_t> row_of) const {
  constexpr std::size_t n = unknown_count;
  using Both = Dual<2 * n>;
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t row = row_of[end[i]];
      if (row == no_index) continue;
      BoundaryInputs<Both> in = boundary_inputs<Both>(state, edge, i);
      for (std::size_t k = 0; k < n; ++k) in.here[k].slope[k] = 1.0, in.there[k].slope[n + k] = 1.0;
      const Fluxes<Both> flux = mesh_.patch(edge).flux(in, stream_);
      Block &own = matrix.at(row, end[i]), &other = matrix.at(row, end[1 - i]);
      for (std::size_t z = 0; z < n * n; ++z)
        own[z] += flux[z / n].slope[z % n], other[z] += flux[z / n].slope[n + z % n];
    }
  }
}

std::array<Vector, augmented_count> FlowSystem::augmented_columns(const State& state) const {
  using Two = Dual<augmented_count>;
  std::array<Vector, augmented_count> columns;
  for (auto& column : columns) column.assign(mesh_.size(), {});
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    if (mesh_.patch(edge).solid()) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      BoundaryInputs<Two> in = boundary_inputs<Two>(state, edge, i);
      in.lift.slope[0] = 1.0, in.alpha.slope[1] = 1.0;
      const Fluxes<Two> flux = mesh_.patch(edge).flux(in, stream_);
      for (std::size_t k = 0; k < unknown_count; ++k)
        for (std::size_t z = 0; z < augmented_count; ++z)
          columns[z][i == 0 ? edge.a : edge.b][k] += flux[k].slope[z];
    }
  }
  return columns;
}

AugmentedRows FlowSystem::augmented_rows(const State& state) const {
  const WallForce lift = {.weight = {.lift = 1.0}};
  return {.first = slopes_by_unknowns(*this, state, lift),
          .corner = {Augmented{-1.0, -coefficients(*this, state).drag},
                     stream_.lift ? Augmented{1.0, 0.0} : Augmented{0.0, 1.0}}};
}

}  // namespace remodel::flow
