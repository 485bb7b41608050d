#include "flow/search/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/search/policy.h"

namespace remodel::flow {

namespace {

template <std::size_t N>
double sum_of_squares(const BlockVector<N>& v) {
  double sum = 0.0;
  for (const auto& block : v)
    for (const double x : block) sum += x * x;
  return sum;
}

}  // namespace

template <std::size_t N>
BlockState<N> moved(const BlockState<N>& state, const BlockIncrement<N>& increment, double length) {
  BlockState<N> result = state;
  for (std::size_t v = 0; v < result.q.size(); ++v) {
    for (std::size_t k = 0; k < N; ++k) result.q[v][k] += length * increment.q[v][k];
    for (const std::size_t k : positive_unknowns)
      result.q[v][k] = std::max(result.q[v][k], SearchPolicy::least_left * state.q[v][k]);
  }
  for (std::size_t z = 0; z < augmented_count; ++z) result.augmented[z] += length * increment.augmented[z];
  return result;
}

template <std::size_t N>
double largest_change(const BlockState<N>& state, const BlockIncrement<N>& increment) {
  double largest = 0.0;
  for (std::size_t v = 0; v < state.q.size(); ++v)
    for (const std::size_t k : positive_unknowns) {
      const double part = std::fabs(increment.q[v][k]) / std::max(state.q[v][k], SearchPolicy::nearly_vacuum);
      if (!(part <= largest)) largest = part;  // NaN stays
    }
  return largest;
}

template <std::size_t N>
BlockIncrement<N> BlockResiduals<N>::negated() const {
  BlockIncrement<N> result{.q = of_vertices, .augmented = {-augmented[0], -augmented[1]}};
  for (auto& block : result.q)
    for (double& x : block) x = -x;
  return result;
}

// Where undisturbed flow has next to no residual (a thin plate along the stream), a thousandth of the
// pressure on the extent of the walls takes its place.
template <std::size_t N>
BlockMeasure<N>::BlockMeasure(const BlockSystem<N>& system) : system_(system) {
  BlockVector<N> residual;
  Augmented augmented;
  system.residuals(system.undisturbed(), residual, augmented);
  scale_ = std::max(std::sqrt(sum_of_squares<N>(residual)), 1e-3 * system.stream().length / gas_gamma);
}

template <std::size_t N>
double BlockMeasure<N>::size_of(const BlockVector<N>& of_vertices, const Augmented& augmented) const {
  double square = sum_of_squares<N>(of_vertices) / (scale_ * scale_);
  for (const double x : augmented) square += x * x;
  const double size = std::sqrt(square);
  return std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
}

template <std::size_t N>
BlockResiduals<N> BlockMeasure<N>::operator()(const BlockState<N>& state) const {
  BlockResiduals<N> found{.size = std::numeric_limits<double>::infinity()};
  for (const auto& q : state.q)
    for (const std::size_t k : positive_unknowns)
      if (!(q[k] > 0.0)) return found;
  system_.residuals(state, found.of_vertices, found.augmented);
  found.size = size_of(found.of_vertices, found.augmented);
  return found;
}

// For each number of unknowns.
#define REMODEL_MEASURE(N)                                                                 \
  template BlockState<N> moved<N>(const BlockState<N>&, const BlockIncrement<N>&, double); \
  template double largest_change<N>(const BlockState<N>&, const BlockIncrement<N>&);       \
  template struct BlockResiduals<N>;                                                       \
  template class BlockMeasure<N>
REMODEL_MEASURE(4);
REMODEL_MEASURE(5);
#undef REMODEL_MEASURE

}  // namespace remodel::flow
