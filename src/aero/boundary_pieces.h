#pragma once

#include <cstdint>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel {

// The vertices along a boundary, piece by piece, whatever the order of its edges is. A closed piece ends with
// the vertex that it begins with; open ones come first.
std::vector<std::vector<std::uint32_t>> boundary_pieces(const FrozenBoundary& boundary);

}  // namespace remodel
