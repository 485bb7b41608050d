#pragma once

// How a living flow is looked for, cheapest first: by older factors; by new ones, at the state as it is; by
// Newton's method from the last flow; from undisturbed flow.

#include <functional>

#include "flow/living_flow/kept_factors.h"
#include "flow/search/search.h"

namespace remodel::flow {

// One flow that is looked for.
template <std::size_t N>
struct LadderTask {
  const BlockMeasure<N>& measure;
  const Keys& keys;
  // Newton's method from the last flow, and from what the search begins with.
  std::function<void(BlockState<N>&)> near, cold;
  SearchRecord& record;
  bool from_last = false;  // whether `state` is the last flow's
  BlockState<N> state = {};
  FlowStart start = FlowStart::cold;
  std::size_t corrected = 0;  // vertices
};

template <std::size_t N>
class Ladder {
 public:
  Ladder(const FlowOptions& options, KeptFactors<N>& kept, BlockWholeMatrix<N>& matrix)
      : options_(options), kept_(kept), matrix_(matrix) {}
  void climb(LadderTask<N>& task);

 private:
  // False where they are of no use (any more).
  bool by_older_factors(LadderTask<N>& task);
  bool by_own_factors(LadderTask<N>& task);

  const FlowOptions& options_;
  KeptFactors<N>& kept_;
  BlockWholeMatrix<N>& matrix_;
};

}  // namespace remodel::flow
