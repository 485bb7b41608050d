#include "flow/search/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/search/policy.h"

namespace remodel::flow {

namespace {

double sum_of_squares(const Vector& v) {
  double sum = 0.0;
  for (const auto& block : v)
    for (const double x : block) sum += x * x;
  return sum;
}

}  // namespace

State moved(const State& state, const Increment& increment, double length) {
  State result = state;
  for (std::size_t v = 0; v < result.q.size(); ++v) {
    for (std::size_t k = 0; k < unknown_count; ++k) result.q[v][k] += length * increment.q[v][k];
    for (const std::size_t k : positive_unknowns)
      result.q[v][k] = std::max(result.q[v][k], SearchPolicy::least_left * state.q[v][k]);
  }
  for (std::size_t z = 0; z < augmented_count; ++z) result.augmented[z] += length * increment.augmented[z];
  return result;
}

double largest_change(const State& state, const Increment& increment) {
  double largest = 0.0;
  for (std::size_t v = 0; v < state.q.size(); ++v)
    for (const std::size_t k : positive_unknowns) {
      const double part = std::fabs(increment.q[v][k]) / std::max(state.q[v][k], SearchPolicy::nearly_vacuum);
      if (!(part <= largest)) largest = part;  // NaN stays
    }
  return largest;
}

Increment Residuals::negated() const {
  Increment result{.q = of_vertices, .augmented = {-augmented[0], -augmented[1]}};
  for (auto& block : result.q)
    for (double& x : block) x = -x;
  return result;
}

// Where undisturbed flow has next to no residual (a thin plate along the stream), a thousandth of the
// pressure on the extent of the walls takes its place.
Measure::Measure(const FlowSystem& system) : system_(system) {
  Vector residual;
  system.residual(system.uniform(), residual);
  scale_ = std::max(std::sqrt(sum_of_squares(residual)), 1e-3 * system.stream().length / gas_gamma);
}

Residuals Measure::operator()(const State& state) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Residuals found{.size = infinity};
  for (const Unknowns<double>& q : state.q)
    for (const std::size_t k : positive_unknowns)
      if (!(q[k] > 0.0)) return found;
  system_.residual(state, found.of_vertices);
  found.augmented = system_.augmented_residual(state);
  double square = sum_of_squares(found.of_vertices) / (scale_ * scale_);
  for (const double x : found.augmented) square += x * x;
  const double size = std::sqrt(square);
  if (std::isfinite(size)) found.size = size;
  return found;
}

}  // namespace remodel::flow
