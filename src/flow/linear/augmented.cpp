#include "flow/linear/augmented.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace remodel::flow {

namespace {

double sum_of_squares(const Vector& v) {
  double sum = 0.0;
  for (const auto& block : v)
    for (const double x : block) sum += x * x;
  return sum;
}

double lift_of(const FlowSystem::AugmentedRows& rows, const Vector& x) {
  double sum = 0.0;
  for (const auto& entry : rows.lift) sum += entry.value * x[entry.vertex][3];
  return sum;
}

}  // namespace

Increment zero(std::size_t vertices) {
  return {.q = Vector(vertices, std::array<double, 4>{}), .augmented = {0.0, 0.0}};
}

// Four sums side by side.
double inner(const Vector& a, const Vector& b) {
  std::array<double, 4> sum = {};
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[v][k] * b[v][k];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

double inner(const Increment& a, const Increment& b) {
  return inner(a.q, b.q) + (a.augmented[0] * b.augmented[0] + a.augmented[1] * b.augmented[1]);
}

double norm(const Increment& a) {
  return std::sqrt(inner(a, a));
}

void add_times(Increment& to, double factor, const Increment& what) {
  for (std::size_t v = 0; v < to.q.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) to.q[v][k] += factor * what.q[v][k];
  for (std::size_t z = 0; z < 2; ++z) to.augmented[z] += factor * what.augmented[z];
}

void add_product(const BlockRows& matrix, double factor, const Vector& x, Vector& to) {
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    std::array<double, 4> sum = to[r];
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const Block& block = matrix.block[i];
      std::array<double, 4> value = x[matrix.column[i]];
      for (double& entry : value) entry *= factor;
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t k = 0; k < 4; ++k) sum[row] += block[4 * row + k] * value[k];
    }
    to[r] = sum;
  }
}

Increment close_augmented(Vector x, const std::array<Vector, 2>& y, const FlowSystem::AugmentedRows& rows,
                          const Augmented& right) {
  // The Schur complement E - D y, where D's second row is empty.
  const double s00 = rows.corner[0][0] - lift_of(rows, y[0]), s01 = rows.corner[0][1] - lift_of(rows, y[1]);
  const double s10 = rows.corner[1][0], s11 = rows.corner[1][1];
  const double r0 = right[0] - lift_of(rows, x), r1 = right[1];
  const double determinant = s00 * s11 - s01 * s10;
  Increment result;
  result.augmented = {(r0 * s11 - s01 * r1) / determinant, (s00 * r1 - s10 * r0) / determinant};
  for (std::size_t v = 0; v < x.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k)
      x[v][k] -= y[0][v][k] * result.augmented[0] + y[1][v][k] * result.augmented[1];
  result.q = std::move(x);
  return result;
}

State moved(const State& state, const Increment& increment, double length) {
  constexpr double least_left = 0.2;  // of a density or pressure
  State result = state;
  for (std::size_t v = 0; v < result.q.size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) result.q[v][k] += length * increment.q[v][k];
    for (const std::size_t k : positive)
      if (result.q[v][k] < least_left * state.q[v][k]) result.q[v][k] = least_left * state.q[v][k];
  }
  for (std::size_t z = 0; z < 2; ++z) result.augmented[z] += length * increment.augmented[z];
  return result;
}

double largest_change(const State& state, const Increment& increment) {
  constexpr double nearly_none = 0.05;
  double largest = 0.0;
  for (std::size_t v = 0; v < state.q.size(); ++v)
    for (const std::size_t k : positive) {
      const double part = std::fabs(increment.q[v][k]) / std::max(state.q[v][k], nearly_none);
      if (!(part <= largest)) largest = part;  // NaN stays
    }
  return largest;
}

// Where undisturbed flow has next to no residual (a thin plate along the stream), a thousandth of the
// pressure on the extent of the walls takes its place.
Measure::Measure(const FlowSystem& system) : system_(system) {
  Vector residual;
  system.residual(system.uniform(), residual);
  scale_ = std::max(std::sqrt(sum_of_squares(residual)), 1e-3 * system.stream().length / gas_gamma);
}

double Measure::operator()(const State& state, Vector& residual, Augmented& augmented) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Unknowns<double>& q : state.q)
    if (!(q[0] > 0.0) || !(q[3] > 0.0)) return infinity;
  system_.residual(state, residual);
  augmented = system_.augmented_residual(state);
  const double size = std::sqrt(sum_of_squares(residual) / (scale_ * scale_) + augmented[0] * augmented[0] +
                                augmented[1] * augmented[1]);
  return std::isfinite(size) ? size : infinity;
}

}  // namespace remodel::flow
