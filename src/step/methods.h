#pragma once

// The two methods, as steps under a journal that remodel() began. Both leave a constrained Delaunay mesh of
// the new domain, labelled, with length scales on the boundary; refinement of what was touched is the
// caller's. Both throw RecoveryError where the new boundary cannot be brought in.

#include "mesh/mesh_data.h"
#include "step/adjust.h"
#include "remodel/remodel.h"
#include "step/replace.h"

namespace remodel {

// The paper's section 4.2 after adjust_all() returned false: adjusts what can be, replaces the rest.
// Returns the vertices that are at other places, but are the same, in the mesh's arena.
List<VertexId> replace_where_needed(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                    const ReplaceOptions& options);

// The paper's section 3: replaces all loops that are not the same in both domains.
void replace_loops(MeshData& mesh, const Domain& domain, const ReplaceOptions& options);

}  // namespace remodel
