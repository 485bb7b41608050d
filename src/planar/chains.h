#pragma once

// The pieces of an arrangement, linked to chains: each runs between two points where not exactly two pieces
// end, or around.

#include <vector>

#include "planar/arrangement.h"

namespace remodel {

struct Chain {
  std::vector<VertexId> vertices;  // around: the first one again at the end
  std::vector<int> markers;        // of each edge
  bool domain_left = false, domain_right = false;
  bool closed() const { return vertices.size() > 1 && !joined && vertices.front() == vertices.back(); }
  bool joined = false;  // it ends at points that others share
};

// Without the edges that have the outside on both sides; these are counted.
std::vector<Chain> link_chains(Arrangement& arrangement);

}  // namespace remodel
