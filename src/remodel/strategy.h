#pragma once

// Strategy::renew: what it adds to a step of the paper's methods.
//
//   once:  K, triangles of a fresh mesh per size (count_control.h)
//   step:  all vertices moved in place: nothing else; after many such steps in a row K is sampled again, and
//          a mesh whose triangle count is off is generated afresh, if that brings it nearer to K. Between two
//          samplings are 1000 designs at least, four times as many with each one
//          otherwise: replace, with more removed around vertices that fail although they hardly move
//          (replace.h), every fifteenth time renew length scales and coarsen within
//          what the count allows, refine new triangles to H and those of the same vertices where they
//          exceed keep H

#include <optional>
#include <span>

#include "mesh/mesh_data.h"
#include "remodel/count_control.h"
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

// Whether the next replacement renews length scales, and those of all replacements since the last one with
// it: much of what changes changes back with the designs, and what two of them change is looked at once.
bool renewal_is_due(const MeshData& mesh);
// That these loops have moved, or all of them: the next renewal looks around them. The first, of ascending
// loops, throws nothing where pending_loops has room for all.
void note_moved(MeshData& mesh, std::span<const std::size_t> loops);
void note_all_moved(MeshData& mesh);

// Under a journal, before a replacement that renews: K and S are known then. Without an earlier measurement
// of K a mesh that was never remodelled is its own; otherwise a few are generated. Returns how many vertices
// coarsening may remove, two triangles each: half of N - K S.
std::size_t prepare_renewal(MeshData& mesh, StepObserver* observer);
// After that replacement, in which these vertices changed their places; before refinement.
RenewedSize renew_replaced(MeshData& mesh, std::span<const VertexId> moved, std::size_t budget);
// After refinement, of each replacement. S stays known where that is cheaper than to sum it up when the next
// renewal asks for it.
void finish_replacement(MeshData& mesh, const std::optional<RenewedSize>& renewed);

// After a replacement by chain: S is not kept up, and the next replacement renews.
void forget_size(MeshData& mesh);

// Whether the triangle count is worth a look after so many full adjustments in a row: the samples that this
// takes cost as much as many steps.
bool refresh_is_due(const MeshData& mesh, std::uint32_t full_adjustments, std::uint32_t designs_a_step);
// Generates a mesh of the same domain. It corrects K, which differs from design to design; then, if the count
// of `mesh` is off by more than 2 % from what K makes of its size, it is returned, if it is off by at most
// half as much. If not, the same once more, with both.
std::optional<GenerateResult> nearer_to_fresh(MeshData& mesh, StepObserver* observer);

}  // namespace remodel
