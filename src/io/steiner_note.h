#pragma once

// What formats have no place for, as comments. Which points of the boundary refinement put there: who reads
// the file back does not take them for points of the design. And how far the keys of vertices have come.

#include <string>
#include <string_view>

#include "remodel/frozen_mesh.h"

namespace remodel::io {

// Lines that begin with `prefix`; empty where there are no such points.
std::string steiner_note(const FrozenMesh& mesh, std::string_view prefix);

// Takes what the text of a mesh's file says of its points. A note of another number of points than the mesh
// has is from another time: it is passed over.
void take_steiner_notes(std::string_view text, FrozenMesh& mesh);

// FrozenMesh::last_generation, of a mesh with keys.
std::string generation_note(const FrozenMesh& mesh);
void take_generation_note(std::string_view text, FrozenMesh& mesh);

}  // namespace remodel::io
