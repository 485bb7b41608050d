#pragma once

#include "mesh/mesh_data.h"

namespace remodel {

// Under a journal, after all boundary edges were recovered: labels every touched triangle, and any other
// whose label changes, by the sides of the boundary edges (RecoveryError if these contradict each other);
// then removes interior vertices outside the domain. Cost proportional to what was touched and what changes
// its side.
void relabel_touched(MeshData& mesh);

}  // namespace remodel
