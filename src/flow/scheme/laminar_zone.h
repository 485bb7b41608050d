#pragma once

// Where a boundary layer is laminar whose transition is given: in vertices whose nearest place on a wall lies
// on a side of a section, ahead of that side's transition.

#include <array>
#include <vector>

namespace remodel::flow {

class FrictionMesh;

// Of each vertex of a mesh that knows the nearest place on a wall of each. The chord of a connected wall goes
// from its rearmost point (the largest x) to the point farthest from that one. They part the wall into a side
// that gas lies above, the upper one, and a lower one. A floor of a duct has nothing but the upper side, a
// ceiling the lower one. transition: of upper and lower sides, chord fractions.
std::vector<bool> laminar_zone(const FrictionMesh& mesh, std::array<double, 2> transition);

}  // namespace remodel::flow
