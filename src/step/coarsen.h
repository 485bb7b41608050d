#pragma once

#include <cstddef>
#include <span>

#include "mesh/mesh_data.h"

namespace remodel {

// Under a journal, before refinement: removes at most `budget` Steiner vertices in the interior of the domain
// that a touched triangle has, or one at the given vertices, those of the triangles first that are smallest
// by their length scales. Only where every triangle that takes their place meets the bounds of refinement and
// encroaches on no boundary edge, so that refinement has nothing to do there. Returns how many.
std::size_t coarsen_touched(MeshData& mesh, std::span<const VertexId> around, std::size_t budget);
// Under a journal: removes every interior vertex of the domain that has a triangle with (r / (H LS))^2 below
// the bound. What takes their place is for refinement to make good. O(triangles).
void remove_dense(MeshData& mesh, double bound);
// Likewise, of Steiner vertices on boundaries and curves, those that can be dissolved: their two edges become
// one. Those that chains share stay. Whether there were any.
bool dissolve_dense(MeshData& mesh, double bound);

}  // namespace remodel
