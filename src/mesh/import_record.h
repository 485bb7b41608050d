#pragma once

// What an imported mesh shows of its file's own triangles.

#include <array>
#include <cstdint>
#include <unordered_map>

#include "mesh/mesh_data.h"

namespace remodel {

// The file's triangles (vertex ids) by the slots of the living triangles that stand in their place: of every
// face of the record that is untouched. A face is untouched if its living triangles are all of the file's own
// birth and of the domain, no boundary runs through it, and its vertices lie so that the file's triangles are
// counter-clockwise: since both triangulations then have the same outline, one can take the other's place.
std::unordered_map<std::uint32_t, std::array<std::uint32_t, 3>> triangles_as_imported(const MeshData& mesh);

}  // namespace remodel
