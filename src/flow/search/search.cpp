#include "flow/search/search.h"

#include <algorithm>
#include <cstdio>

namespace remodel::flow {

FactorKind lasting_kind(const FlowOptions& options) {
  return options.solver == FlowSolver::gmres ? FactorKind::incomplete : FactorKind::whole;
}

void SearchRecord::end_without_factors(Factored outcome, double memory_mb_given) {
  char text[128];
  if (outcome == Factored::out_of_memory) {
    status = FlowStatus::memory;
    std::snprintf(text, sizeof text, "even incomplete factors need more than the %.2g MB that they may take",
                  memory_mb_given);
  } else {
    status = FlowStatus::stalled;
    std::snprintf(text, sizeof text, "the Jacobian, or its incomplete LU, is singular at a residual of %.2g",
                  residual);
  }
  reason = text;
}

template <std::size_t N>
BlockMatrix<N>& BlockWholeMatrix<N>::of(const BlockSystem<N>& system) {
  if (cells_ != system.mesh().cells()) {
    matrix_ = system.pattern();
    cells_ = system.mesh().cells();
  }
  return matrix_;
}

template <std::size_t N>
Factored BlockSearch<N>::factor(const BlockSystem<N>& system, const BlockState<N>& state,
                                const BlockMatrix<N>& matrix, FactorKind kind) {
  const Factored outcome = factors_.factor(matrix, system.augmented_columns(state), kind, options_.memory_mb);
  ++record_.factorisations;
  if (outcome != Factored::done) return outcome;
  record_.memory_mb = std::max(record_.memory_mb, factors_.memory_mb());
  record_.whole_factors = factors_.whole();
  return outcome;
}

template <std::size_t N>
Factored BlockSearch<N>::factor_at(const BlockSystem<N>& system, const BlockState<N>& state,
                                   FactorKind kind) {
  BlockMatrix<N>& matrix = matrix_.of(system);
  system.jacobian(state, matrix);
  return factor(system, state, matrix, kind);
}

template class BlockWholeMatrix<4>;
template class BlockWholeMatrix<5>;
template class BlockSearch<4>;
template class BlockSearch<5>;

}  // namespace remodel::flow
