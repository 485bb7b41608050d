#pragma once

// Where a boundary layer is laminar whose transition is given: in vertices whose nearest place on a wall lies
// on a side of a section, ahead of that side's transition.

#include <array>
#include <cstdint>
#include <vector>

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// Of each vertex. `nearest` has each vertex's nearest boundary edge of a wall that gas sticks to, or
// no_index. The chord of a connected wall goes from its rearmost point (the largest x) to the point farthest
// from that one. They part a closed wall into an upper and a lower side. A wall that is not closed has one
// side: the upper where gas lies above its chord, as on the floor of a duct. transition: of upper and lower
// sides, chord fractions.
std::vector<bool> laminar_zone(const FlowMesh& mesh, const std::vector<std::uint32_t>& nearest,
                               std::array<double, 2> transition);

}  // namespace remodel::flow
