#pragma once

// What all searches for a flow have: options, a record of what was done, the Jacobian and its factors.

#include <string>
#include <vector>

#include "flow/linear/factors.h"
#include "flow/scheme/block_system.h"
#include "flow/search/measure.h"
#include "remodel/flow.h"

namespace remodel::flow {

// What a search for a flow has done so far.
struct SearchRecord {
  FlowStatus status = FlowStatus::stalled;
  std::string reason;
  double residual = 0.0;
  std::vector<double> history;
  int newton_steps = 0, factorisations = 0, iterations = 0, gmres_iterations = 0;
  int in_vain = 0;  // Newton steps from potential flow that led nowhere; newton_steps is without them
  FlowOrigin origin = FlowOrigin::last_flow;
  double memory_mb = 0.0;
  bool whole_factors = true;

  void interrupt() { status = FlowStatus::interrupted, reason = "interrupted"; }
  void end_without_factors(Factored outcome, double memory_mb_given);
};

// Whether a flow that was not found from another one is looked for from nothing.
inline bool begins_again(const SearchRecord& record, const FlowOptions& options) {
  return options.retry_cold &&
         (record.status == FlowStatus::stalled || record.status == FlowStatus::step_limit);
}

// The kind of factors that serve for several solves.
FactorKind lasting_kind(const FlowOptions& options);

// The whole matrix, whose pattern is kept while a mesh has the same cells.
template <std::size_t N>
class BlockWholeMatrix {
 public:
  BlockMatrix<N>& of(const BlockSystem<N>& system);

 private:
  BlockMatrix<N> matrix_;
  std::vector<Cell> cells_;
};
using WholeMatrix = BlockWholeMatrix<unknown_count>;

template <std::size_t N>
class BlockSearch {
 public:
  // What a search leaves in `factors` belongs to its last step.
  BlockSearch(const FlowOptions& options, BlockWholeMatrix<N>& matrix, BlockFactors<N>& factors,
              SearchRecord& record)
      : options_(options), matrix_(matrix), factors_(factors), record_(record) {}

  const FlowOptions& options() const { return options_; }
  SearchRecord& record() { return record_; }
  BlockFactors<N>& factors() { return factors_; }

  // Jacobian and factors at a state, without pseudo-time; counted in the record.
  Factored factor_at(const BlockSystem<N>& system, const BlockState<N>& state, FactorKind kind);

 protected:
  Factored factor(const BlockSystem<N>& system, const BlockState<N>& state, const BlockMatrix<N>& matrix,
                  FactorKind kind);

  const FlowOptions& options_;
  BlockWholeMatrix<N>& matrix_;
  BlockFactors<N>& factors_;
  SearchRecord& record_;
};

}  // namespace remodel::flow
