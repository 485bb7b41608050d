#pragma once

#include <span>

#include "mesh/mesh_data.h"

namespace remodel {

// Under a journal, after all boundary edges were recovered, all other triangles being labelled as they were
// before these edges were torn: labels the given triangles, and any other whose
// label changes, by the sides of the boundary edges (RecoveryError if these contradict each other); then
// removes interior vertices outside the domain. Cost proportional to what is given and what changes its side.
void relabel(MeshData& mesh, std::span<const TriangleId> uncertain);
// The same for every touched triangle that is not as it was.
void relabel_touched(MeshData& mesh);
// The triangles that were touched since the triangulation's mark, in the mesh's arena.
List<TriangleId> alive_since_mark(MeshData& mesh);

}  // namespace remodel
