#include "flow/living_flow/adjoint.h"

#include <algorithm>

#include "flow/linear/gmres.h"
#include "flow/search/policy.h"

namespace remodel::flow {

template <std::size_t N>
Adjoint<N>::Adjoint(const BlockSystem<N>& system, const BlockState<N>& state, const BlockMatrix<N>& matrix,
                    BlockFactors<N>& factors, const Overlap& overlap, const FlowOptions& options)
    : matrix_(matrix, system.augmented_columns(state), system.augmented_rows(state)),
      factors_(factors),
      overlap_(overlap),
      options_(options) {
  if (!overlap.zone.empty()) {
    zone_ = rows_of(matrix, overlap.zone);
    ready_ = zone_lu_.factor(zone_, options.memory_mb) == Factored::done;
    if (!ready_) return;
  }
  const BlockAugmentedRows<N>& rows = matrix_.rows();
  for (std::size_t z = 0; z < augmented_count; ++z) {
    columns_[z] = overlap.to_vertices(factors.columns()[z]);
    small_[z] = {rows.corner[0][z] - rows.times(columns_[z]), rows.corner[1][z]};
  }
}

template <std::size_t N>
void Adjoint<N>::precondition_vertices(BlockVector<N>& x) {
  BlockVector<N> rest(zone_.rows.size());
  if (!rest.empty()) {
    for (std::size_t r = 0; r < rest.size(); ++r) rest[r] = x[zone_.rows[r]];
    zone_lu_.solve_transposed(rest, 1);
    add_transposed(zone_, -1.0, rest, x);
  }
  BlockVector<N> earlier = overlap_.to_rows(x);
  factors_.solve_transposed(earlier);
  x = overlap_.to_vertices(earlier);
  for (std::size_t r = 0; r < rest.size(); ++r)
    for (std::size_t k = 0; k < N; ++k) x[zone_.rows[r]][k] += rest[r][k];
}

template <std::size_t N>
void Adjoint<N>::precondition(BlockIncrement<N>& x) {
  const double s0 = x.augmented[0] - inner(columns_[0], x.q), s1 = x.augmented[1] - inner(columns_[1], x.q);
  const double determinant = small_[0][0] * small_[1][1] - small_[0][1] * small_[1][0];
  x.augmented = {(s0 * small_[1][1] - small_[0][1] * s1) / determinant,
                 (small_[0][0] * s1 - small_[1][0] * s0) / determinant};
  matrix_.rows().add_transposed(-x.augmented[0], x.q);
  precondition_vertices(x.q);
}

// With whole factors the residual is kept as small as rounding lets it by beginning anew once.
template <std::size_t N>
bool Adjoint<N>::solve(const BlockIncrement<N>& right, double most_solves, BlockIncrement<N>& guess,
                       int& iterations) {
  using Policy = SearchPolicy;
  const double wanted =
      std::clamp(options_.tolerance, Policy::least_adjoint, Policy::most_adjoint) * norm(right);
  const bool whole = factors_.whole();
  const GmresEnd end =
      gmres_of<N>([&](const BlockIncrement<N>& x) { return matrix_.transposed_times(x); },
                  [&](BlockIncrement<N>& x) { precondition(x); }, right,
                  {.wanted = wanted,
                   .restart = whole ? Policy::adjoint_steps : factors_.restart(),
                   .rounds = whole ? Policy::adjoint_rounds : Policy::incomplete_adjoint_rounds,
                   .most_iterations = most_solves,
                   .observer = options_.observer},
                  guess);
  iterations += end.iterations;
  return end.in_time && end.residual <= Policy::rounding_slack * wanted;
}

template <std::size_t N>
bool Adjoint<N>::solve(std::span<const BlockIncrement<N>> functions,
                       std::vector<BlockIncrement<N>>& multipliers, double most_solves, int& iterations) {
  if (!ready_) return false;
  multipliers.resize(functions.size());
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const int before = iterations;
    if (!solve(functions[i], most_solves, multipliers[i], iterations)) return false;
    most_solves -= iterations - before;
  }
  return true;
}

template class Adjoint<4>;
template class Adjoint<5>;

}  // namespace remodel::flow
