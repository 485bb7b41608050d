#pragma once

// Walls that gas sticks to, in order.

#include <cstdint>
#include <vector>

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// The boundary edges of a connected wall, each beginning where the one before ends, the gas on their left.
struct WallChain {
  std::vector<std::uint32_t> edges;
  bool closed = false;
};

// All of them. Where walls touch, chains end: what goes on there is not known.
std::vector<WallChain> wall_chains(const FlowMesh& mesh);

}  // namespace remodel::flow
