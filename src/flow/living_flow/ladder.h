#pragma once

// How a living flow is looked for, cheapest first: by older factors; by new ones, at the state as it is; by
// Newton's method from the last flow; from undisturbed flow.

#include "flow/living_flow/kept_factors.h"
#include "flow/search/newton_search.h"

namespace remodel::flow {

// One flow that is looked for.
struct LadderTask {
  const Measure& measure;
  const Keys& keys;
  const FlowConditions& conditions;
  const Mesh* living;  // the mesh that was frozen, if its domain is to be used
  bool from_last;      // whether `state` is the last flow's
  State state;
  SearchRecord record = {}, spent = {};  // spent: on coarser meshes
  FlowStart start = FlowStart::cold;
  std::size_t corrected = 0;  // vertices
};

class Ladder {
 public:
  Ladder(const FlowOptions& options, KeptFactors& kept, WholeMatrix& matrix)
      : options_(options), kept_(kept), matrix_(matrix) {}
  void climb(LadderTask& task);

 private:
  // False where they are of no use (any more).
  bool by_older_factors(LadderTask& task);
  bool by_own_factors(LadderTask& task);

  const FlowOptions& options_;
  KeptFactors& kept_;
  WholeMatrix& matrix_;
  Factors passing_;  // of steps of which each has a matrix of its own
};

}  // namespace remodel::flow
