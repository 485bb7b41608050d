#pragma once

// The rung of Strategy::morph: boundary vertices come to their places on the new design, the interior moves
// along with them (wall_field.h), and edges that are no longer Delaunay are flipped.
//
// Where triangles would turn over, the change is made in parts: boundary vertices go a part of the straight
// way, flips restore the Delaunay property, and the interior is displaced anew from there.

#include <optional>

#include "step/adjust.h"

namespace remodel {

// Under a journal, after adjust_all() returned false. The vertices that are at other places, in the mesh's
// arena; nothing where triangles turn over in the smallest parts too: then the caller takes the step back.
// Angles, gradation and encroachment are left to refinement. Throws RecoveryError where the hull crosses
// itself.
std::optional<List<VertexId>> morph_mesh(MeshData& mesh, AdjustCache& cache, const Domain& domain);

}  // namespace remodel
