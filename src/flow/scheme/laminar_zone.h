#pragma once

// Where a boundary layer is laminar whose transition is given: in vertices whose nearest place on a wall lies
// on a side of a section, ahead of that side's transition.

#include <array>
#include <cstdint>
#include <vector>

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// Of each vertex. `nearest` has each vertex's nearest boundary edge of a wall that gas sticks to, or
// no_index, and `from` where it is that near from. The chord of a connected wall goes from its rearmost point
// (the largest x) to the point farthest from that one. They part the wall into a side that gas lies above,
// the upper one, and a lower one. A floor of a duct has nothing but the upper side, a ceiling the lower one.
// transition: of upper and lower sides, chord fractions.
std::vector<bool> laminar_zone(const FlowMesh& mesh, const std::vector<std::uint32_t>& nearest,
                               const std::vector<Point>& from, std::array<double, 2> transition);

}  // namespace remodel::flow
