#include "flow/living_flow/adjoint.h"

#include <algorithm>
#include <cmath>

#include "flow/linear/gmres.h"

namespace remodel::flow {

namespace {

// to += factor times the transposed matrix times x, the r-th of x for its r-th row.
void add_transposed(const BlockRows& matrix, double factor, const Vector& x, Vector& to) {
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    std::array<double, 4> from = x[r];
    for (double& value : from) value *= factor;
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const Block& block = matrix.block[i];
      std::array<double, 4>& sum = to[matrix.column[i]];
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += block[4 * row + k] * from[row];
    }
  }
}

// Some rows of the whole matrix.
BlockRows rows_of(const BlockRows& matrix, const std::vector<std::uint32_t>& rows) {
  BlockRows some{.rows = rows, .start = {0}, .column = {}, .block = {}};
  for (const std::uint32_t r : rows) {
    const auto from = matrix.start[r], to = matrix.start[r + 1];
    some.column.insert(some.column.end(), matrix.column.begin() + from, matrix.column.begin() + to);
    some.block.insert(some.block.end(), matrix.block.begin() + from, matrix.block.begin() + to);
    some.start.push_back(static_cast<std::uint32_t>(some.column.size()));
  }
  return some;
}

}  // namespace

Increment TransposedSystem::times(const Increment& x) const {
  Increment result = zero(x.q.size());
  add_transposed(matrix_, 1.0, x.q, result.q);
  for (const auto& entry : rows_.lift) result.q[entry.vertex][3] += entry.value * x.augmented[0];
  for (std::size_t z = 0; z < 2; ++z)
    result.augmented[z] =
        inner(columns_[z], x.q) + rows_.corner[0][z] * x.augmented[0] + rows_.corner[1][z] * x.augmented[1];
  return result;
}

TransposedInverse::TransposedInverse(const TransposedSystem& system, Factors& factors, const Overlap& overlap,
                                     double memory_mb)
    : rows_(system.augmented_rows()), factors_(factors), overlap_(overlap) {
  if (!overlap.zone.empty()) {
    zone_ = rows_of(system.matrix(), overlap.zone);
    ready_ = zone_lu_.factor(zone_, memory_mb) == Factored::done;
    if (!ready_) return;
  }
  for (std::size_t z = 0; z < 2; ++z) {
    columns_[z].assign(overlap.row_of.size(), {});
    for (std::size_t v = 0; v < overlap.row_of.size(); ++v)
      if (overlap.row_of[v] != no_index) columns_[z][v] = factors.columns()[z][overlap.row_of[v]];
    small_[z] = {rows_.corner[0][z], rows_.corner[1][z]};
    for (const auto& entry : rows_.lift) small_[z][0] -= columns_[z][entry.vertex][3] * entry.value;
  }
}

void TransposedInverse::apply_to_vertices(Vector& x) {
  Vector rest(zone_.rows.size());
  if (!rest.empty()) {
    for (std::size_t r = 0; r < rest.size(); ++r) rest[r] = x[zone_.rows[r]];
    zone_lu_.solve_transposed(rest, 1);
    add_transposed(zone_, -1.0, rest, x);
  }
  Vector earlier(overlap_.rows, {0, 0, 0, 0});
  for (std::size_t v = 0; v < x.size(); ++v)
    if (overlap_.row_of[v] != no_index) earlier[overlap_.row_of[v]] = x[v];
  factors_.solve_transposed(earlier);
  for (std::size_t v = 0; v < x.size(); ++v)
    x[v] = overlap_.row_of[v] != no_index ? earlier[overlap_.row_of[v]] : std::array<double, 4>{};
  for (std::size_t r = 0; r < rest.size(); ++r)
    for (std::size_t k = 0; k < 4; ++k) x[zone_.rows[r]][k] += rest[r][k];
}

void TransposedInverse::apply(Increment& x) {
  const double s0 = x.augmented[0] - inner(columns_[0], x.q), s1 = x.augmented[1] - inner(columns_[1], x.q);
  const double determinant = small_[0][0] * small_[1][1] - small_[0][1] * small_[1][0];
  x.augmented = {(s0 * small_[1][1] - small_[0][1] * s1) / determinant,
                 (small_[0][0] * s1 - small_[1][0] * s0) / determinant};
  for (const auto& entry : rows_.lift) x.q[entry.vertex][3] -= entry.value * x.augmented[0];
  apply_to_vertices(x.q);
}

// With whole factors the residual is kept as small as rounding lets it by beginning anew once.
bool solve_transposed(const TransposedSystem& system, TransposedInverse& inverse, const Increment& right,
                      const TransposedLimits& limits, Increment& guess, int& iterations) {
  const double wanted = limits.tolerance * norm(right);
  const Factors& factors = inverse.factors();
  const GmresEnd end = gmres([&](const Increment& x) { return system.times(x); },
                             [&](Increment& x) { inverse.apply(x); }, right,
                             {.wanted = wanted,
                              .restart = factors.whole() ? 25 : factors.restart(),
                              .rounds = factors.whole() ? 2 : 10,
                              .most_iterations = limits.most_solves,
                              .observer = limits.observer},
                             guess);
  iterations += end.iterations;
  constexpr double slack = 10.0;  // rounding of the residual itself
  return end.in_time && end.residual <= slack * wanted;
}

std::optional<std::vector<Total>> totals(const FlowSystem& system, const State& state,
                                         const BlockRows& matrix, Factors& factors, const Overlap& overlap,
                                         const FlowOptions& options, std::span<const ForceSlope> functions,
                                         std::vector<Increment>& multipliers, double most_solves,
                                         int& iterations) {
  const TransposedSystem transposed(system, state, matrix);
  TransposedInverse inverse(transposed, factors, overlap, options.memory_mb);
  if (!inverse.ready()) return std::nullopt;
  multipliers.resize(functions.size());
  constexpr double least = 1e-12, most = 1e-8;  // rounding allows no less
  const double tolerance = std::clamp(options.tolerance, least, most);
  std::vector<Vector> weights;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    Increment right = zero(system.mesh().size());
    for (std::size_t v = 0; v < right.q.size(); ++v) right.q[v][3] = functions[i].pressure[v];
    right.augmented[1] = functions[i].alpha;
    const int before = iterations;
    const TransposedLimits limits{tolerance, most_solves, options.observer};
    if (!solve_transposed(transposed, inverse, right, limits, multipliers[i], iterations)) return std::nullopt;
    most_solves -= iterations - before;
    weights.push_back(multipliers[i].q);
  }
  const std::vector<ShapeSlope> by_residual = system.residual_slopes(state, weights);
  const ForceSlope lift = system.force_slope(state, {.lift = 1.0});
  std::vector<Total> result;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    // The augmented's equations are "lift of the walls = lift of the vortex" and "angle, or lift = the given
    // one", whose derivative by the given one is -1.
    const auto [by_lift, by_condition] = multipliers[i].augmented;
    Total& total = result.emplace_back(Total{.shape = functions[i].shape, .condition = by_condition});
    for (std::size_t v = 0; v < total.shape.points.size(); ++v)
      total.shape.points[v] =
          total.shape.points[v] - by_residual[i].points[v] - by_lift * lift.shape.points[v];
    // The limiter's length is the distance between two vertices.
    const Extent& extent = system.mesh().extent();
    const Point far = system.mesh().points()[extent.b] - system.mesh().points()[extent.a];
    const Point by_far = (by_residual[i].length * system.stream().length / dot(far, far)) * far;
    total.shape.points[extent.b] = total.shape.points[extent.b] - by_far;
    total.shape.points[extent.a] = total.shape.points[extent.a] + by_far;
    total.shape.mach += -by_residual[i].mach - by_lift * lift.shape.mach;
  }
  return result;
}

}  // namespace remodel::flow
