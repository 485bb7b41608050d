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

}  // namespace remodel
