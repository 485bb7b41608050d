#pragma once

// The boundary of a mesh as closed loops: one far field, bodies inside it.

#include <cstdint>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel::flow {

struct WallLoop {
  std::string name;                     // of its boundary; several are joined by '+'
  std::vector<std::uint32_t> vertices;  // the domain on the left
};

struct WallLoops {
  WallLoop farfield;
  std::vector<WallLoop> bodies;  // in the order of the mesh's boundaries
};

// Throws Error (argument) naming `source` unless every edge with one triangle belongs to a named boundary,
// the loops do not touch, one is the far field, counter-clockwise, of all the names of `farfield` and no
// other, and the others are holes.
WallLoops find_wall_loops(const FrozenMesh& mesh, const std::vector<std::string>& farfield,
                          const std::string& source);

}  // namespace remodel::flow
