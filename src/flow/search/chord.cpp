#include "flow/search/chord.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace remodel::flow {

namespace {

Increment minus(const Increment& a, const Increment& b) {
  Increment result = a;
  for (std::size_t v = 0; v < a.q.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) result.q[v][k] -= b.q[v][k];
  for (std::size_t z = 0; z < 2; ++z) result.augmented[z] -= b.augmented[z];
  return result;
}

void subtract(Increment& from, double factor, const Increment& what) {
  for (std::size_t v = 0; v < from.q.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) from.q[v][k] -= factor * what.q[v][k];
  for (std::size_t z = 0; z < 2; ++z) from.augmented[z] -= factor * what.augmented[z];
}

double product(const Increment& a, const Increment& b) {
  double sum = a.augmented[0] * b.augmented[0] + a.augmented[1] * b.augmented[1];
  for (std::size_t v = 0; v < a.q.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) sum += a.q[v][k] * b.q[v][k];
  return sum;
}

}  // namespace

void Anderson::add(Difference difference) {
  if (differences_.size() == depth) {
    differences_.pop_front();
    const Eigen::Index left = products_.rows() - 1;
    products_ = products_.bottomRightCorner(left, left).eval();
  }
  differences_.push_back(std::move(difference));
  const auto m = static_cast<Eigen::Index>(differences_.size());
  products_.conservativeResize(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
    products_(m - 1, i) = products_(i, m - 1) =
        product(differences_.back().f, differences_[static_cast<std::size_t>(i)].f);
}

// Least squares by normal equations of normalised columns: cheap, and as good as what the acceleration needs;
// columns that hardly add anything are left out by the rank that Eigen finds.
Increment Anderson::step(Increment f) {
  if (last_) add({minus(f, *last_), std::move(taken_)});
  last_ = f;
  const auto m = static_cast<Eigen::Index>(differences_.size());
  Increment step = std::move(f);
  if (m > 0) {
    Eigen::VectorXd right(m), norm = products_.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < m; ++i) {
      right(i) = product(differences_[static_cast<std::size_t>(i)].f, *last_);
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
      subtract(step, gamma(i), differences_[static_cast<std::size_t>(i)].f);
      subtract(step, gamma(i), differences_[static_cast<std::size_t>(i)].x);
    }
  }
  taken_ = step;
  return step;
}

void Anderson::scale_last(double taken) {
  for (auto& block : taken_.q)
    for (double& x : block) x *= taken;
  for (double& x : taken_.augmented) x *= taken;
}

Preconditioner::Preconditioner(const FlowSystem& system, const State& state, Factors& factors,
                               std::vector<std::uint32_t> row_of, std::size_t rows,
                               const std::vector<std::uint32_t>& zone, const FlowOptions& options)
    : system_(system), factors_(factors), row_of_(std::move(row_of)), rows_(rows) {
  if (!zone.empty()) {
    zone_ = system.pattern(zone);
    system.jacobian(state, zone_);
    ready_ = zone_lu_.factor(zone_, options.memory_mb) == Factored::done;
    if (!ready_) return;
  }
  const std::array<Vector, 2> right = system.augmented_columns(state);
  for (std::size_t z = 0; z < 2; ++z) {
    columns_[z].assign(row_of_.size(), {});
    for (std::size_t v = 0; v < row_of_.size(); ++v)
      if (row_of_[v] != no_index) columns_[z][v] = factors_.columns()[z][row_of_[v]];
    correct(right[z], columns_[z]);
  }
}

// x += J_zz^-1 (right - J x) on the zone.
void Preconditioner::correct(const Vector& right, Vector& x) {
  if (zone_.rows.empty()) return;
  Vector rest(zone_.rows.size());
  for (std::size_t r = 0; r < zone_.rows.size(); ++r) rest[r] = right[zone_.rows[r]];
  add_product(zone_, -1.0, x, rest);
  zone_lu_.solve(rest, 1);
  for (std::size_t r = 0; r < zone_.rows.size(); ++r)
    for (std::size_t k = 0; k < 4; ++k) x[zone_.rows[r]][k] += rest[r][k];
}

Increment Preconditioner::apply(const State& state, const Vector& residual, const Augmented& augmented) {
  Vector right(residual.size());
  for (std::size_t v = 0; v < residual.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) right[v][k] = -residual[v][k];
  Vector inner(rows_, {0, 0, 0, 0});
  for (std::size_t v = 0; v < right.size(); ++v)
    if (row_of_[v] != no_index) inner[row_of_[v]] = right[v];
  factors_.solve(inner);
  Vector x(right.size(), {0, 0, 0, 0});
  for (std::size_t v = 0; v < right.size(); ++v)
    if (row_of_[v] != no_index) x[v] = inner[row_of_[v]];
  correct(right, x);
  return close_augmented(std::move(x), columns_, system_.augmented_rows(state),
                         {-augmented[0], -augmented[1]});
}

ChordEnd chord_steps(const Measure& measure, Preconditioner& inverse, const Factors& factors,
                     const FlowOptions& options, State& state, Search& search) {
  constexpr std::size_t limit = 60, watched = 4;  // steps; over which the contraction is looked at
  constexpr double largest_part = 0.4, rise = 6.0, fruitless = 0.9;
  Anderson anderson;
  Vector residual;
  Augmented augmented;
  State best = state;
  double least = measure(state, residual, augmented);
  search.residual = least;
  std::vector<double> sizes{least};
  search.history.push_back(least);
  const auto end = [&](ChordEnd how) {
    state = std::move(best);
    search.residual = least;
    return how;
  };
  for (std::size_t i = 0; i < limit && least > options.tolerance; ++i) {
    if (options.observer != nullptr && options.observer->cancelled()) return end(ChordEnd::interrupted);
    const Increment step = anderson.step(inverse.apply(state, residual, augmented));
    const double length = std::min(1.0, largest_part / largest_change(state, step));
    if (!(length > 0.0)) return end(ChordEnd::slow);
    if (length < 1.0) anderson.scale_last(length);
    state = moved(state, step, length);
    const double size = measure(state, residual, augmented);
    ++search.iterations;
    if (!(size <= rise * sizes.front() && size <= 100.0 * least)) return end(ChordEnd::slow);
    sizes.push_back(size);
    search.history.push_back(size);
    if (size < least) least = size, best = state;
    if (sizes.size() <= watched || least <= options.tolerance) continue;
    const double rate = std::pow(least / sizes[sizes.size() - 1 - watched], 1.0 / double{watched});
    if (!(rate < fruitless)) return end(ChordEnd::slow);
    const double left = std::log(options.tolerance / least) / std::log(rate);
    if (left * factors.solve_work() > factors.factor_work() + double{watched} * factors.solve_work())
      return end(ChordEnd::slow);
  }
  return end(least <= options.tolerance ? ChordEnd::converged : ChordEnd::slow);
}

ChordEnd steps_with_own_factors(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                                BlockRows& matrix, Factors& factors, State& state, Search& search) {
  // Above this residual Newton's method wants pseudo-time; below a gain of less than this, too.
  constexpr double reach = 0.3, least_gain = 0.3;
  constexpr int attempts = 4;
  Vector residual;
  Augmented augmented;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const double before = measure(state, residual, augmented);
    if (!(before < reach)) return ChordEnd::slow;
    const Factored outcome =
        factor_at(system, state, no_pseudo_time, FactorKind::whole, options, matrix, factors, search);
    ++search.newton_steps;
    if (outcome != Factored::done || !factors.whole()) return ChordEnd::slow;
    std::vector<std::uint32_t> same(state.q.size());
    std::iota(same.begin(), same.end(), 0U);
    Preconditioner inverse(system, state, factors, std::move(same), state.q.size(), {}, options);
    const ChordEnd end = chord_steps(measure, inverse, factors, options, state, search);
    if (end == ChordEnd::interrupted) {
      search.status = FlowStatus::interrupted, search.reason = "interrupted";
      return end;
    }
    if (end == ChordEnd::converged) {
      search.status = FlowStatus::converged;
      return end;
    }
    if (!(search.residual < least_gain * before)) return end;
  }
  return ChordEnd::slow;
}

}  // namespace remodel::flow
