#include "flow/search/chord.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace remodel::flow {

template <std::size_t N>
void Anderson<N>::add(Difference difference) {
  if (differences_.size() == SearchPolicy::anderson_depth) {
    differences_.pop_front();
    const Eigen::Index left = products_.rows() - 1;
    products_ = products_.bottomRightCorner(left, left).eval();
  }
  differences_.push_back(std::move(difference));
  const auto m = static_cast<Eigen::Index>(differences_.size());
  products_.conservativeResize(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
    products_(m - 1, i) = products_(i, m - 1) =
        inner(differences_.back().f, differences_[static_cast<std::size_t>(i)].f);
}

// Least squares by normal equations of normalised columns: cheap, and as good as what the acceleration needs;
// columns that hardly add anything are left out by the rank that Eigen finds.
template <std::size_t N>
BlockIncrement<N> Anderson<N>::step(BlockIncrement<N> f) {
  if (last_) {
    BlockIncrement<N> change = f;
    add_times(change, -1.0, *last_);
    add({std::move(change), std::move(taken_)});
  }
  last_ = f;
  const auto m = static_cast<Eigen::Index>(differences_.size());
  BlockIncrement<N> step = std::move(f);
  if (m > 0) {
    Eigen::VectorXd right(m), norm = products_.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < m; ++i) {
      right(i) = inner(differences_[static_cast<std::size_t>(i)].f, *last_);
      if (!(norm(i) > 0.0)) norm(i) = 1.0;
    }
    const Eigen::MatrixXd scaled =
        norm.cwiseInverse().asDiagonal() * products_ * norm.cwiseInverse().asDiagonal();
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-12);
    solver.compute(scaled);
    const Eigen::VectorXd gamma =
        norm.cwiseInverse().asDiagonal() * solver.solve(right.cwiseQuotient(norm)).eval();
    for (Eigen::Index i = 0; i < m; ++i) {
      add_times(step, -gamma(i), differences_[static_cast<std::size_t>(i)].f);
      add_times(step, -gamma(i), differences_[static_cast<std::size_t>(i)].x);
    }
  }
  taken_ = step;
  return step;
}

template <std::size_t N>
void Anderson<N>::scale_last(double taken) {
  for (auto& block : taken_.q)
    for (double& x : block) x *= taken;
  for (double& x : taken_.augmented) x *= taken;
}

template <std::size_t N>
Preconditioner<N>::Preconditioner(const BlockSystem<N>& system, const BlockState<N>& state,
                                  BlockFactors<N>& factors, Overlap overlap, double memory_mb)
    : factors_(factors), overlap_(std::move(overlap)), rows_(system.augmented_rows(state)) {
  if (!overlap_.zone.empty()) {
    zone_ = system.pattern(overlap_.zone);
    system.jacobian(state, zone_);
    ready_ = zone_lu_.factor(zone_, memory_mb) == Factored::done;
    if (!ready_) return;
  }
  const std::array<BlockVector<N>, augmented_count> right = system.augmented_columns(state);
  for (std::size_t z = 0; z < augmented_count; ++z) {
    columns_[z] = overlap_.to_vertices(factors_.columns()[z]);
    correct(right[z], columns_[z]);
  }
}

// x += J_zz^-1 (right - J x) on the zone.
template <std::size_t N>
void Preconditioner<N>::correct(const BlockVector<N>& right, BlockVector<N>& x) {
  if (zone_.rows.empty()) return;
  BlockVector<N> rest(zone_.rows.size());
  for (std::size_t r = 0; r < zone_.rows.size(); ++r) rest[r] = right[zone_.rows[r]];
  add_product(zone_, -1.0, x, rest);
  zone_lu_.solve(rest, 1);
  for (std::size_t r = 0; r < zone_.rows.size(); ++r)
    for (std::size_t k = 0; k < N; ++k) x[zone_.rows[r]][k] += rest[r][k];
}

template <std::size_t N>
BlockIncrement<N> Preconditioner<N>::apply(const BlockResiduals<N>& residuals) {
  const BlockIncrement<N> right = residuals.negated();
  BlockVector<N> rows = overlap_.to_rows(right.q);
  factors_.solve(rows);
  BlockVector<N> x = overlap_.to_vertices(rows);
  correct(right.q, x);
  return close_augmented(std::move(x), columns_, rows_, right.augmented);
}

template <std::size_t N>
ChordEnd chord_steps(const BlockMeasure<N>& measure, Preconditioner<N>& inverse, BlockSearch<N>& search,
                     BlockState<N>& state) {
  using Policy = SearchPolicy;
  const FlowOptions& options = search.options();
  SearchRecord& record = search.record();
  const double solve_work = search.factors().solve_work();
  Anderson<N> anderson;
  BlockResiduals<N> residuals = measure(state);
  BlockState<N> best = state;
  double least = residuals.size;
  record.residual = least;
  std::vector<double> sizes{least};
  record.history.push_back(least);
  const auto end = [&](ChordEnd how) {
    state = std::move(best);
    record.residual = least;
    return how;
  };
  for (std::size_t i = 0; i < Policy::chord_steps && least > options.tolerance; ++i) {
    if (options.observer != nullptr && options.observer->cancelled()) return end(ChordEnd::interrupted);
    const BlockIncrement<N> step = anderson.step(inverse.apply(residuals));
    const double length = std::min(1.0, Policy::largest_part / largest_change(state, step));
    if (!(length > 0.0)) return end(ChordEnd::slow);
    if (length < 1.0) anderson.scale_last(length);
    state = moved(state, step, length);
    residuals = measure(state);
    const double size = residuals.size;
    ++record.iterations;
    if (!(size <= Policy::chord_rise * sizes.front() && size <= Policy::chord_rise_of_least * least))
      return end(ChordEnd::slow);
    sizes.push_back(size);
    record.history.push_back(size);
    if (size < least) least = size, best = state;
    if (sizes.size() <= Policy::watched || least <= options.tolerance) continue;
    const double rate =
        std::pow(least / sizes[sizes.size() - 1 - Policy::watched], 1.0 / double{Policy::watched});
    if (!(rate < Policy::fruitless)) return end(ChordEnd::slow);
    const double left = std::log(options.tolerance / least) / std::log(rate);
    if (left * solve_work > search.factors().factor_work() + double{Policy::watched} * solve_work)
      return end(ChordEnd::slow);
  }
  return end(least <= options.tolerance ? ChordEnd::converged : ChordEnd::slow);
}

template <std::size_t N>
ChordEnd steps_with_own_factors(const BlockMeasure<N>& measure, BlockSearch<N>& search,
                                BlockState<N>& state) {
  const BlockSystem<N>& system = measure.system();
  SearchRecord& record = search.record();
  for (int attempt = 0; attempt < SearchPolicy::own_attempts; ++attempt) {
    const double before = measure(state).size;
    if (!(before < SearchPolicy::reach)) return ChordEnd::slow;
    const Factored outcome = search.factor_at(system, state, FactorKind::whole);
    ++record.newton_steps;
    if (outcome != Factored::done || !search.factors().whole()) return ChordEnd::slow;
    Overlap same{.row_of = std::vector<std::uint32_t>(state.q.size()), .rows = state.q.size(), .zone = {}};
    std::iota(same.row_of.begin(), same.row_of.end(), 0U);
    Preconditioner<N> inverse(system, state, search.factors(), std::move(same), search.options().memory_mb);
    const ChordEnd end = chord_steps(measure, inverse, search, state);
    if (end == ChordEnd::interrupted) record.interrupt();
    if (end == ChordEnd::converged) record.status = FlowStatus::converged;
    if (end != ChordEnd::slow || !(record.residual < SearchPolicy::least_gain * before)) return end;
  }
  return ChordEnd::slow;
}

// For each number of unknowns.
#define REMODEL_CHORD(N)                                                                        \
  template class Anderson<N>;                                                                   \
  template class Preconditioner<N>;                                                             \
  template ChordEnd chord_steps<N>(const BlockMeasure<N>&, Preconditioner<N>&, BlockSearch<N>&, \
                                   BlockState<N>&);                                             \
  template ChordEnd steps_with_own_factors<N>(const BlockMeasure<N>&, BlockSearch<N>&, BlockState<N>&)
REMODEL_CHORD(4);
REMODEL_CHORD(5);
#undef REMODEL_CHORD

}  // namespace remodel::flow
