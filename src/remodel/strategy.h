#pragma once

// Strategy::renew: what it adds to a step of the paper's methods.
//
//   once:  K, triangles of a fresh mesh per size (count_control.h)
//   step:  all vertices moved in place: nothing else; after many such steps in a row K is sampled again, and
//          a mesh whose triangle count is off is generated afresh, if that brings it nearer to K. Between two
//          samplings are 250 steps at least, twice as many with each one, until the mesh is generated afresh
//          otherwise: replace, renew length scales, coarsen within what the count allows, refine new
//          triangles to H and the kept ones where they exceed keep H

#include <optional>
#include <span>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"

namespace remodel {

// Whether a step of the mesh renews. An imported mesh has measured length scales, which the boundary does not
// determine.
bool renews(const MeshData& mesh, const RemodelOptions& options);
// The tolerance on H of kept triangles, as given or by gradation.
double resolved_keep(const RemodelOptions& options, const QualityOptions& quality);

// Measures K from fresh meshes of the mesh's present domain, and notes S.
void calibrate(MeshData& mesh, int samples, StepObserver* observer = nullptr);

// Under a journal, before the replacement: K and S are known from then on. Without an earlier measurement of
// K a mesh that was never remodelled is its own; otherwise a few are generated. Returns how many vertices
// coarsening may remove, two triangles each: half of N - K S.
std::size_t prepare_renewal(MeshData& mesh, StepObserver* observer);
// After the replacement around the given loops, in which these vertices were moved in place; before
// refinement.
void renew_replaced(MeshData& mesh, std::span<const std::size_t> loops, std::span<const VertexId> moved,
                    std::size_t budget);
// After refinement.
void finish_renewal(MeshData& mesh);

// Whether the triangle count is worth a look after so many full adjustments in a row: the samples that this
// takes cost as much as many steps.
bool refresh_is_due(const MeshData& mesh, std::uint32_t full_adjustments);
// Generates a few meshes of the same domain. They correct K, which differs from design to design; then, if
// the count of `mesh` is off by more than 2 %, the one that is nearest to K is returned, if it is off by less
// than half as much.
std::optional<GenerateResult> nearer_to_fresh(MeshData& mesh, StepObserver* observer);

}  // namespace remodel
