#pragma once

// How many triangles a mesh should have, without generating another one.
//
// Words: the *size* of a mesh is S = sum over the domain triangles of area / (H LS)^2, with the mean of
// 1 / LS^2 over the three vertices. It depends on the design and hardly on the triangles, and fresh meshes of
// one discretisation and gradation have nearly the same number of triangles per size, whatever the design:
// the *count factor* K. A mesh of N triangles has a surplus of about N / (K S) - 1.
//
// S comes in two parts. Triangles with a boundary vertex, which every step changes, are summed when needed;
// they are in proportion to the boundary. The sum over all others is kept from step to step and corrected by
// what the journal says, while steps are small for the mesh; otherwise it is summed up when needed.

#include <cstddef>
#include <optional>

#include "mesh/mesh_data.h"
#include "remodel/generate.h"

namespace remodel {

// The part of S in triangles without a boundary vertex, of the whole mesh: O(triangles).
double interior_size(const MeshData& mesh);
// Makes it known to the mesh, if it is not.
void know_interior_size(MeshData& mesh);
// The part that the triangles at a vertex have because of its own length scale is
//   free_area / (3 H^2 LS^2),
// but for those with a boundary vertex and those that the journal has.
double free_area(const MeshData& mesh, VertexId v);
// A renewal of length scales under a journal: what it did to S in triangles that the journal did not have by
// then, and how many of its entries are from before it (earlier(), earlier_vertices()).
struct RenewedSize {
  double change = 0.0;
  std::size_t triangles = 0, vertices = 0;
};
// interior_size() under a journal that began when it was `before`, with a renewal or without one: O(what
// changed).
double corrected_interior_size(MeshData& mesh, double before, const std::optional<RenewedSize>& renewed);
// The part in triangles with a boundary vertex: O(boundary).
double boundary_size(MeshData& mesh);

// S, and N / S. Precondition: the mesh's interior_size is known.
double total_size(MeshData& mesh);
double triangles_per_size(MeshData& mesh);

// A fresh mesh of the same domain, made to H times a factor of at most 1, with its S. A triangle count is
// chaotic: meshes with factors that differ by a tenth of a percent are samples. Their count is in proportion
// to 1 / h_factor^2.
GenerateResult fresh_sample(const MeshData& like, double h_factor, StepObserver* observer);
// K from that many samples; those that cannot be finished are left out.
double measured_count_factor(const MeshData& mesh, int samples, StepObserver* observer);

}  // namespace remodel
