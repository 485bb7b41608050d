#pragma once

// The two rungs of Strategy::morph. Boundary vertices come to their places on the new design, and single
// vertices of the interior are moved to mend what that spoils (relax.h). On the first rung that is all, and
// has to be enough. On the second the whole interior moves along with the walls before (wall_field.h), and
// edges that are not Delaunay after all are flipped.
//
// Where triangles would turn over, the second rung makes the change in parts: boundary vertices go a part of
// the straight way, the interior is mended, and displaced anew from there.

#include <optional>

#include "step/adjust.h"

namespace remodel {

enum class Interior { still, along };

// Under a journal, after adjust_all() returned false. The vertices that are at other places, in the mesh's
// arena; nothing where triangles turn over in the smallest parts too, or where a still interior is not
// enough: then the caller takes the step back. What misses these bounds on angles and gradation after all is
// left to refinement. Throws RecoveryError where the hull crosses itself.
std::optional<List<VertexId>> morph_mesh(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                         Interior interior, const QualityBounds& bounds);

}  // namespace remodel
