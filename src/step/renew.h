#pragma once

// Renewal of length scales after the boundary has changed. The paper never renews the length scale of a
// Steiner vertex: a step can only lower what a new vertex inherits, so that meshes grow with every step (its
// "surplus").
//
// Words: the length scales of non-Steiner vertices are *given* by the curves. All others follow: that of a
// Steiner vertex v is
//
//   F(v) = min over the domain edges v-u of LS(u) + |uv| / G,
//
// on a boundary no more than the interpolation by length between the non-Steiner neighbours. LS = F
// everywhere has one solution, the lengths of shortest paths from the given vertices.
//
// What is promised: after renewal LS(v) differs from F(v) by at most a tolerance
// (RenewPolicy::length_scale_tolerance), at all vertices that
// renewal visited. Along a path of edges such errors add up, but length scales grow along it as well, by
// |uv| / G an edge: errors of one sign come to at most tolerance * (1 + G LS / |uv|).

#include <span>
#include <vector>

#include "mesh/mesh_data.h"

namespace remodel {

// Under a journal: renews the length scales of the vertices around the given loops, of the given vertices as
// far as they are still there, and of touched triangles, and on from there as far as they change by more than
// the tolerance. Triangles at vertices whose length scale fell count as touched; returns the vertices whose
// length scale rose. The cost is proportional to the vertices visited, and to the logarithm of their number.
//
// Source: the two phases of G. Ramalingam and T. Reps, "An incremental algorithm for a generalization of the
// shortest-path problem", 1996, with a tolerance: first those that lost what their length scale came from are
// invalidated, in ascending order; then Dijkstra's algorithm goes over these and what falls.
List<VertexId> renew_length_scales(MeshData& mesh, std::span<const std::uint32_t> loops,
                                   std::span<const std::uint32_t> vertices);

// The solution of LS = F for all vertices, by slot: what renewal approximates. Those of no domain triangle
// keep what they have. O(n log n).
std::vector<double> propagated_length_scales(const MeshData& mesh);

}  // namespace remodel
