#pragma once

// What Strategy::renew adds to a step of the paper's methods. Its numbers are in mesh/renew_policy.h.
//
//   once:  K, the triangles of a fresh mesh per size (count_control.h), is measured.
//   step:  Where all vertices move in place nothing else is done; after many such steps in a row K is sampled
//          again, and a mesh whose triangle count is off is generated afresh, if that brings it nearer to K.
//          Otherwise vertices are replaced, with more removed around those that fail although they hardly
//          move (replace.h); at every fifteenth replacement length scales are renewed and the mesh is
//          coarsened within what the count allows; new triangles are refined to H, kept ones where they
//          exceed keep H.

#include <optional>
#include <span>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/correspondence.h"

namespace remodel {

// Whether a step of the mesh renews. An imported mesh has measured length scales, which the boundary does not
// determine.
bool renews(const MeshData& mesh, const RemodelOptions& options);
// The tolerance on H of kept triangles, as given or by gradation.
double resolved_keep(const RemodelOptions& options, const QualityOptions& quality);

// Measures K from fresh meshes of the mesh's present domain.
void calibrate(MeshData& mesh, int samples, StepObserver* observer = nullptr);

// Whether the next replacement renews length scales, and those of all replacements since the last one with
// it: much of what changes changes back with the designs, and what two of them change is looked at once.
bool renewal_is_due(const MeshData& mesh);
// That these loops have moved, or those that are not the same in the domain to come, by whose order loops are
// counted from then on: the next renewal looks around them. The first, of ascending loops, throws nothing
// where pending_loops has room for all.
void note_moved(MeshData& mesh, std::span<const std::size_t> loops);
void note_changed(MeshData& mesh, const Correspondence& to);

// Under a journal, before a replacement that renews. Measures K if it is not known: a mesh that was never
// remodelled is its own sample; otherwise a few are generated. Returns how many vertices coarsening may
// remove, two triangles each: half of N - K S.
std::size_t prepare_renewal(MeshData& mesh, StepObserver* observer);
// After that replacement, in which these vertices changed their places; before refinement.
void renew_replaced(MeshData& mesh, std::span<const VertexId> moved, std::size_t budget);
// After a replacement that changed the discretisation: measures K, which depends on it, and lets this and the
// next replacements shed what the mesh has too much.
void discretisation_changed(MeshData& mesh, StepObserver* observer);
// Imported meshes are not renewed. K of one that is morphed is what it has before the first time.
void count_imported(MeshData& mesh);
// Whether the mesh has more triangles than a fresh one by more than this share; false while K is not known.
bool has_surplus(const MeshData& mesh, double tolerated);
// Where the surplus is large, removes what is dense anywhere. True if refinement has to fill in.
bool shed_surplus(MeshData& mesh);
// After refinement, of each replacement: what the next renewal has to look at, unless this one renewed.
void finish_replacement(MeshData& mesh, bool renewed);

// After a replacement by chain: the next one by renew renews.
void replaced_by_chain(MeshData& mesh);

// Whether the triangle count is worth a look: the samples that this takes cost as much as many steps.
bool refresh_is_due(const MeshData& mesh, std::uint32_t designs_a_step);
// Generates a mesh of the same domain. It corrects K, which differs from design to design; then, if the count
// of `mesh` is off by more than the tolerated excess from what K makes of its size, it is returned, if it is
// off by at most half as much. If not, the same once more, with both.
std::optional<GenerateResult> nearer_to_fresh(MeshData& mesh, StepObserver* observer);

}  // namespace remodel
