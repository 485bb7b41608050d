#include "flow/linear/factors.h"

#include <algorithm>

#include "flow/linear/gmres.h"

namespace remodel::flow {

namespace {

// GMRES is slow where it begins anew after less than 20 steps, and seldom takes more than 60.
constexpr int longest_restart = 60, shortest_restart = 20;

}  // namespace

template <std::size_t N>
Factored BlockFactors<N>::factor(const BlockMatrix<N>& matrix,
                                 std::array<BlockVector<N>, augmented_count> augmented, FactorKind kind,
                                 double memory_mb) {
  Factored outcome = Factored::out_of_memory;
  restart_ = longest_restart;
  if (kind == FactorKind::whole && !too_large(matrix.rows.size())) {
    incomplete_.forget();
    outcome = lu_.factor(matrix, memory_mb);
    if (outcome == Factored::out_of_memory) too_large_ = matrix.rows.size();
  }
  if (outcome == Factored::out_of_memory) {
    lu_.forget();
    outcome = factor_incompletely(matrix, memory_mb);
  }
  if (outcome != Factored::done) return outcome;
  columns_ = std::move(augmented);
  for (BlockVector<N>& column : columns_) solve(column);
  return outcome;
}

template <std::size_t N>
Factored BlockFactors<N>::factor_incompletely(const BlockMatrix<N>& matrix, double memory_mb) {
  const double vector_mb = gmres_vector_mb(N, matrix.rows.size());
  // A level that served this pattern before serves again.
  int level = incomplete_.is_of(matrix) ? incomplete_.level() : highest_level_;
  for (; level >= 0; --level) {
    const double room = (memory_mb - incomplete_.analysed_mb(matrix, level)) / vector_mb - gmres_kept;
    const int shortest = level > 0 ? longest_restart / 2 : shortest_restart;
    if (room < shortest) continue;
    restart_ = static_cast<int>(std::min(room, double{longest_restart}));
    return incomplete_.factor(matrix) ? Factored::done : Factored::singular;
  }
  incomplete_.forget();
  return Factored::out_of_memory;
}

template <std::size_t N>
void BlockFactors<N>::solve(BlockVector<N>& right) {
  if (whole())
    lu_.solve(right, 1);
  else
    incomplete_.solve(right);
}

template <std::size_t N>
void BlockFactors<N>::solve_transposed(BlockVector<N>& right) {
  if (whole())
    lu_.solve_transposed(right, 1);
  else
    incomplete_.solve_transposed(right);
}

template <std::size_t N>
double BlockFactors<N>::memory_mb() const {
  if (whole() || !incomplete_.ready()) return lu_.memory_mb();
  return incomplete_.memory_mb() + (restart_ + gmres_kept) * gmres_vector_mb(N, columns_[0].size());
}

// Incomplete factors are made in the time of about ten solves.
template <std::size_t N>
double BlockFactors<N>::factor_work() const {
  return whole() ? lu_.factor_work() : 10.0 * solve_work();
}

template <std::size_t N>
double BlockFactors<N>::solve_work() const {
  return whole() ? lu_.solve_work() : double{N * N} * static_cast<double>(incomplete_.blocks());
}

template class BlockFactors<4>;
template class BlockFactors<5>;

}  // namespace remodel::flow
