#pragma once

// Derivatives of flows with friction by their unknowns: members of FrictionSystem, which friction_system.cpp
// instantiates.

#include <algorithm>
#include <cmath>

#include "flow/scheme/friction_system.h"
#include "flow/scheme/image_rows.h"

namespace remodel::flow {

// visit(row, column) for all pairs that residuals have, some of them several times.
template <std::size_t N>
template <class Visit>
void FrictionSystem<N>::for_each_dependence(Order order, Visit visit) const {
  for (std::uint32_t v = 0; v < dual_.size(); ++v) visit(v, v), visit(v, dual_.counterpart(v));
  for (std::size_t e = 0; e < dual_.edges().size(); ++e) {
    const DualEdge& edge = dual_.edges()[e];
    visit(edge.a, edge.b), visit(edge.b, edge.a);
    if (order == Order::first) continue;
    for (std::size_t side = 0; side < 2; ++side)
      for (const WeightedVertex& of : mesh_.upwind(e, side))
        visit(edge.a, of.vertex), visit(edge.b, of.vertex);
  }
  for (const CornerTriangle& triangle : mesh_.triangles())
    for (const std::uint32_t row : triangle.corner)
      for (const std::uint32_t column : triangle.corner) visit(row, column);
}

template <std::size_t N>
BlockMatrix<N> FrictionSystem<N>::pattern(std::vector<std::uint32_t> rows, Order order) const {
  BlockMatrix<N> matrix;
  matrix.rows = std::move(rows);
  const std::vector<std::uint32_t> row_of = rows_of_vertices(matrix, order).of;
  std::vector<std::vector<std::uint32_t>> columns(matrix.rows.size());
  for_each_dependence(order, [&](std::uint32_t row, std::uint32_t column) {
    if (row_of[row] == no_index) return;
    std::vector<std::uint32_t>& of = columns[row_of[row]];
    const auto at = std::lower_bound(of.begin(), of.end(), column);
    if (at == of.end() || *at != column) of.insert(at, column);
  });
  matrix.start.assign(1, 0);
  for (const std::vector<std::uint32_t>& of : columns) {
    matrix.column.insert(matrix.column.end(), of.begin(), of.end());
    matrix.start.push_back(static_cast<std::uint32_t>(matrix.column.size()));
  }
  matrix.block.resize(matrix.column.size());
  return matrix;
}

template <std::size_t N>
typename FrictionSystem<N>::Rows FrictionSystem<N>::rows_of_vertices(BlockMatrix<N>& matrix,
                                                                     Order order) const {
  Rows rows = {matrix, order, std::vector<std::uint32_t>(dual_.size(), no_index)};
  for (std::uint32_t r = 0; r < matrix.rows.size(); ++r) rows.of[matrix.rows[r]] = r;
  return rows;
}

template <std::size_t N>
void FrictionSystem<N>::add_fluxes(const BlockState<N>& state, std::span<Rows> all) const {
  for (Rows& rows : all) {
    std::fill(rows.matrix.block.begin(), rows.matrix.block.end(), SquareBlock<N>{});
    add_face_blocks(state, rows);
  }
  add_triangle_blocks(state, all);
  if (N == 5) add_source_blocks(state, all);
  add_boundary_blocks(state, all);
}

template <std::size_t N>
void FrictionSystem<N>::jacobian(const BlockState<N>& state, BlockMatrix<N>& matrix) const {
  Rows rows[] = {rows_of_vertices(matrix, Order::whole)};
  add_fluxes(state, rows);
  make_walls_strong(matrix);
  set_image_rows(dual_, matrix);
}

template <std::size_t N>
void FrictionSystem<N>::jacobian(const BlockState<N>& state, Jacobian& result) const {
  if (result.whole.rows.size() != dual_.size()) {
    result.whole = pattern();
    result.first = pattern(result.whole.rows, Order::first);
  }
  result.first.block.resize(result.first.column.size());  // whoever factors it may have taken its blocks
  Rows rows[] = {rows_of_vertices(result.whole, Order::whole), rows_of_vertices(result.first, Order::first)};
  add_fluxes(state, rows);
  result.rows = augmented_rows(state, result.whole);
  for (BlockMatrix<N>* matrix : {&result.whole, &result.first})
    make_walls_strong(*matrix), set_image_rows(dual_, *matrix);
}

// A reconstructed value depends on that unknown at both ends, on its upwind difference, and by the limiter on
// all unknowns at both ends and on the edge's length.
template <std::size_t N>
template <std::size_t V>
typename FrictionSystem<N>::template FaceDual<V> FrictionSystem<N>::face_dual(const BlockState<N>& state,
                                                                              std::size_t e,
                                                                              Order order) const {
  using T = Dual<V>;
  using One = Dual<5>;
  constexpr std::size_t n = unknown_count;
  const DualEdge& edge = dual_.edges()[e];
  FaceDual<V> face;
  Unknowns<Dual<2 * n>> end[2];
  for (std::size_t k = 0; k < n; ++k) {
    end[0][k] = Dual<2 * n>::variable(state.q[edge.a][k], k);
    end[1][k] = Dual<2 * n>::variable(state.q[edge.b][k], n + k);
  }
  if (order == Order::whole) face.limited = limited_part<Dual<2 * n>>(end[0], end[1]);
  const One limited = One::variable(face.limited.value, 3);
  const One width = One::variable(terms_.limiter_width(dual_.vector(edge)), 4);
  std::array<T, N> value[2];
  for (std::size_t side = 0; side < 2; ++side) {
    Row upwind = {};
    for (const WeightedVertex& of : mesh_.upwind(e, side))
      for (std::size_t k = 0; k < N; ++k) upwind[k] += of.weight * state.q[of.vertex][k];
    for (std::size_t k = 0; k < N; ++k) {
      const One q[2] = {One::variable(state.q[edge.a][k], 0), One::variable(state.q[edge.b][k], 1)};
      One& at = face.reconstructed[side][k] = q[side];
      if (order == Order::whole) {
        const One behind = One::variable(upwind[k], 2), central = q[1] - q[0];
        const One to = k < unknown_count ? terms_.step(behind, central, width, limited)
                                         : terms_.working_step(behind, central);
        at = side == 0 ? q[0] + to : q[1] - to;
      }
      if (k == positive_unknowns[0] || k == positive_unknowns[1]) at = positivity_limited(at, q[side]);
      value[side][k] = T::variable(at.value, N * side + k);
    }
  }
  if constexpr (V == 2 * N) {
    face.flux = terms_.template face_flux<T, N>(value[0], value[1], PlaneVector<double>(edge.normal));
  } else {
    const PlaneVector<T> normal = {T::variable(edge.normal.x, 2 * N), T::variable(edge.normal.y, 2 * N + 1)};
    face.flux = terms_.template face_flux<T, N>(value[0], value[1], normal);
  }
  return face;
}

template <std::size_t N>
void FrictionSystem<N>::add_face_blocks(const BlockState<N>& state, Rows& rows) const {
  for (std::size_t e = 0; e < dual_.edges().size(); ++e) {
    const DualEdge& edge = dual_.edges()[e];
    const std::uint32_t end[2] = {edge.a, edge.b};
    if (rows.of[end[0]] == no_index && rows.of[end[1]] == no_index) continue;
    const auto [flux, reconstructed, limited] = face_dual<2 * N>(state, e, rows.order);
    SquareBlock<N> by_end[2] = {{}, {}}, by_upwind[2] = {{}, {}};
    Row by_limited = {};
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < N; ++k)
        for (std::size_t side = 0; side < 2; ++side) {
          const double slope = flux[i].slope[N * side + k];
          const std::array<double, 5>& of = reconstructed[side][k].slope;
          by_limited[i] += slope * of[3];
          by_end[0][N * i + k] += slope * of[0], by_end[1][N * i + k] += slope * of[1];
          by_upwind[side][N * i + k] = slope * of[2];
        }
    for (std::size_t i = 0; limited.value > 0.0 && i < N; ++i)
      for (std::size_t k = 0; k < 2 * unknown_count; ++k)
        by_end[k / unknown_count][N * i + k % unknown_count] += by_limited[i] * limited.slope[k];
    for (std::size_t row = 0; row < 2; ++row) {
      if (rows.of[end[row]] == no_index) continue;
      const double sign = row == 0 ? 1.0 : -1.0;
      const auto add = [&](std::uint32_t column, double factor, const SquareBlock<N>& block) {
        SquareBlock<N>& to = rows.matrix.at(rows.of[end[row]], column);
        for (std::size_t z = 0; z < N * N; ++z) to[z] += factor * block[z];
      };
      for (std::size_t side = 0; side < 2; ++side) {
        add(end[side], sign, by_end[side]);
        if (rows.order == Order::first) continue;
        for (const WeightedVertex& of : mesh_.upwind(e, side))
          add(of.vertex, sign * of.weight, by_upwind[side]);
      }
    }
  }
}

template <std::size_t N>
void FrictionSystem<N>::add_triangle_blocks(const BlockState<N>& state, std::span<Rows> all) const {
  using All = Dual<3 * N>;
  const auto is_wanted = [&](std::uint32_t v) {
    return std::any_of(all.begin(), all.end(), [&](const Rows& rows) { return rows.of[v] != no_index; });
  };
  for (const CornerTriangle& triangle : mesh_.triangles()) {
    if (std::none_of(std::begin(triangle.corner), std::end(triangle.corner), is_wanted)) continue;
    std::array<std::array<All, N>, 3> q;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < N; ++k) q[i][k] = All::variable(state.q[triangle.corner[i]][k], N * i + k);
    const auto flux = terms_.template triangle<All, N>(q, triangle, turbulent_corners(triangle));
    for (Rows& rows : all)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t row = rows.of[triangle.corner[i]];
        for (std::size_t j = 0; row != no_index && j < 3; ++j) {
          SquareBlock<N>& block = rows.matrix.at(row, triangle.corner[j]);
          for (std::size_t m = 0; m < N; ++m)
            for (std::size_t k = 0; k < N; ++k) block[N * m + k] += flux[i][m].slope[N * j + k];
        }
      }
  }
}

// What turbulence makes at a vertex, by its own unknowns and by the velocities that its vorticity is of.
template <std::size_t N>
void FrictionSystem<N>::add_source_blocks(const BlockState<N>& state, std::span<Rows> all) const {
  using T = Dual<N + 1>;
  for (std::uint32_t v = 0; v < dual_.size(); ++v) {
    if (!has_turbulence(v)) continue;
    Local<T, N> q;
    for (std::size_t k = 0; k < N; ++k) q[k] = T::variable(state.q[v][k], k);
    const T turning = T::variable(vorticity(state.q, v), N);
    const T made = terms_.template made<T, N, double>(q, turning, mesh_.area(v), wall_place(v));
    for (Rows& rows : all) {
      if (rows.of[v] == no_index) continue;
      SquareBlock<N>& own = rows.matrix.at(rows.of[v], v);
      const auto row = [](SquareBlock<N>& block) { return block.data() + N * (N - 1); };
      for (std::size_t k = 0; k < N; ++k) row(own)[k] -= made.slope[k];
      for (std::size_t k = 0; k < dual_.ring(v).size(); ++k) {
        const Point by = made.slope[N] * mesh_.mean_gradient(v)[k];
        double* there = row(rows.matrix.at(rows.of[v], dual_.ring(v)[k].vertex));
        there[1] += by.y, there[2] -= by.x;
        row(own)[1] -= by.y, row(own)[2] += by.x;
      }
    }
  }
}

template <std::size_t N>
void FrictionSystem<N>::add_boundary_blocks(const BlockState<N>& state, std::span<Rows> all) const {
  constexpr std::size_t n = unknown_count;
  using Both = Dual<N + n>;
  for (const BoundaryEdge& edge : dual_.boundary()) {
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (std::size_t i = 0; i < 2; ++i) {
      BoundaryInputs<Both> in = boundary_inputs<Both>(state, edge, i);
      std::array<Both, N> here;
      for (std::size_t k = 0; k < N; ++k) here[k] = Both::variable(state.q[end[i]][k], k);
      for (std::size_t k = 0; k < n; ++k) in.here[k].slope[k] = 1.0, in.there[k].slope[N + k] = 1.0;
      const std::array<Both, N> flux =
          terms_.template boundary_flux<Both, N>(dual_.patch(edge), in, here, stream_);
      for (Rows& rows : all) {
        const std::uint32_t at = rows.of[end[i]];
        if (at == no_index) continue;
        SquareBlock<N>&own = rows.matrix.at(at, end[i]), &other = rows.matrix.at(at, end[1 - i]);
        for (std::size_t row = 0; row < N; ++row) {
          for (std::size_t k = 0; k < N; ++k) own[N * row + k] += flux[row].slope[k];
          for (std::size_t k = 0; k < n; ++k) other[N * row + k] += flux[row].slope[N + k];
        }
      }
    }
  }
}

template <std::size_t N>
void FrictionSystem<N>::make_walls_strong(BlockMatrix<N>& matrix) const {
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    const std::uint32_t v = matrix.rows[r];
    if (!mesh_.sticks(v)) continue;
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i)
      for (std::size_t z = 0; z < N * N; ++z)
        if (is_strong(z / N)) matrix.block[i][z] = matrix.column[i] == v ? strong_slope(z / N, z % N) : 0.0;
  }
}

template <std::size_t N>
BlockMatrix<N> FrictionSystem<N>::raw_rows_of_walls(const BlockState<N>& state) const {
  std::vector<std::uint32_t> walls;
  for (std::uint32_t v = 0; v < dual_.size(); ++v)
    if (mesh_.sticks(v)) walls.push_back(v);
  BlockMatrix<N> raw = pattern(std::move(walls));
  Rows rows[] = {rows_of_vertices(raw, Order::whole)};
  add_fluxes(state, rows);
  return raw;
}

template <std::size_t N>
BlockAugmentedRows<N> FrictionSystem<N>::augmented_rows(const BlockState<N>& state) const {
  return augmented_rows(state, raw_rows_of_walls(state));
}

// The lift of all walls: friction by the unbalanced momentum of their vertices.
template <std::size_t N>
BlockAugmentedRows<N> FrictionSystem<N>::augmented_rows(const BlockState<N>& state,
                                                        const BlockMatrix<N>& raw) const {
  BlockAugmentedRows<N> rows;
  const double ca = std::cos(state.augmented[1]), sa = std::sin(state.augmented[1]);
  const double scale = 1.0 / (0.5 * stream_.mach * stream_.mach * stream_.length);
  std::vector<bool> of_wall(dual_.size(), false);
  for (const BoundaryEdge& edge : dual_.boundary()) {
    if (!dual_.patch(edge).solid()) continue;
    of_wall[edge.a] = of_wall[edge.b] = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const double by = scale * (edge.half[i].y * ca - edge.half[i].x * sa);
      Row here = {}, there = {};
      here[3] = 0.75 * by, there[3] = 0.25 * by;
      rows.first.push_back({i == 0 ? edge.a : edge.b, here});
      rows.first.push_back({i == 0 ? edge.b : edge.a, there});
    }
  }
  for (std::size_t r = 0; r < raw.rows.size(); ++r) {
    const std::uint32_t v = raw.rows[r];
    if (!of_wall[v] || !mesh_.sticks(v)) continue;
    for (std::uint32_t i = raw.start[r]; i < raw.start[r + 1]; ++i) {
      Row by;
      for (std::size_t k = 0; k < N; ++k)
        by[k] = -scale * (raw.block[i][2 * N + k] * ca - raw.block[i][N + k] * sa);
      rows.first.push_back({raw.column[i], by});
    }
  }
  BlockVector<N> balance;
  unbalanced(state, balance);
  rows.corner = {Augmented{-1.0, -forces(state, balance).drag},
                 stream_.lift ? Augmented{1.0, 0.0} : Augmented{0.0, 1.0}};
  return rows;
}

// Walls have none: the far field's vortex and angle do not reach their rows.
template <std::size_t N>
std::array<BlockVector<N>, augmented_count> FrictionSystem<N>::augmented_columns(
    const BlockState<N>& state) const {
  using Two = Dual<augmented_count>;
  std::array<BlockVector<N>, augmented_count> columns;
  for (auto& column : columns) column.assign(dual_.size(), {});
  for (const BoundaryEdge& edge : dual_.boundary()) {
    if (dual_.patch(edge).solid()) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t v = i == 0 ? edge.a : edge.b;
      BoundaryInputs<Two> in = boundary_inputs<Two>(state, edge, i);
      in.lift.slope[0] = 1.0, in.alpha.slope[1] = 1.0;
      std::array<Two, N> here;
      for (std::size_t k = 0; k < N; ++k) here[k] = Two(state.q[v][k]);
      const std::array<Two, N> flux =
          terms_.template boundary_flux<Two, N>(dual_.patch(edge), in, here, stream_);
      for (std::size_t k = 0; k < N; ++k)
        for (std::size_t z = 0; z < augmented_count; ++z)
          if (!mesh_.sticks(v) || !is_strong(k)) columns[z][v][k] += flux[k].slope[z];
    }
  }
  return columns;
}

}  // namespace remodel::flow
