#pragma once

// The two methods, as steps under a journal that remodel() began. Both leave a constrained Delaunay mesh of
// the new domain, labelled, with length scales on the boundary; refinement of what was touched is the
// caller's. Both throw RecoveryError where the new boundary cannot be brought in.

#include "mesh/mesh_data.h"
#include "remodel/remodel.h"
#include "step/adjust.h"
#include "step/correspondence.h"
#include "step/replace.h"

namespace remodel {

// The paper's section 4.2 after adjust_all() returned false: adjusts what can be, replaces the rest.
// Returns the vertices that are at other places, but are the same, in the mesh's arena.
List<VertexId> replace_where_needed(MeshData& mesh, AdjustCache& cache, const Domain& domain,
                                    const ReplaceOptions& options);

// The paper's section 3: replaces the boundary by that of `to`, but for what is linked.
// wanted: stations come to lie where they lie on the new domain. What is linked, but would move, is replaced.
// present: what is linked stays where it is. The boundary gets the structure of the new domain, mostly at the
// places of the old one, from where it is moved: settle(), replace_where_needed(), morph_mesh().
// joined: likewise, but where stations of the old loop are gone, what they held apart comes together before.
// Left apart it would squeeze what is between.
enum class Places { wanted, present, joined };
void replace_loops(MeshData& mesh, const Correspondence& to, Places places, const ReplaceOptions& options);

// After that: the loops that have vertices elsewhere than on the domain, ascending. Vertices of refinement
// that are only roundings away, on loops that rest otherwise, are moved there first, and listed in `settled`.
List<std::size_t> settle(MeshData& mesh, List<VertexId>& settled);

}  // namespace remodel
