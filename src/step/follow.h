#pragma once

// The rung of Strategy::reference: every vertex goes to where the design has it on the boundary, and to where
// the field of wall_field.h takes it from its place on the reference; nothing else of the mesh changes.
//
// What depends on the reference alone is kept with the mesh: the field, what each vertex sees of it, and the
// lists of the triangles and edges that have to be judged.

#include <span>

#include "mesh/mesh_data.h"
#include "remodel/remodel.h"

namespace remodel {

// Moves the mesh to the design, and returns what that came to, where it can be held: all triangles within
// reach of `moving` (the loops in which the design differs from the reference, or from the mesh itself where
// it has none) keep the promised bounds, and their edges the angle sum of 180 degrees and the slack. That
// depends on the reference and the design alone. Otherwise nothing has changed, and the result is not held.
// Nothing throws once the mesh is touched, unless under a journal.
RemodelResult follow_reference(MeshData& mesh, const Domain& domain, std::span<const std::size_t> moving,
                               double slack_deg);

// Under a journal: the mesh becomes its reference, which it then has no more.
void return_to_reference(MeshData& mesh);

}  // namespace remodel
