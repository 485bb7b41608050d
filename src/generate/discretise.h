#pragma once

#include "mesh/mesh_data.h"

namespace remodel {

// The constrained Delaunay triangulation of a domain's stations, labelled, with length scales: what
// refinement starts from. Precondition: mesh.domain is valid, the rest of mesh is empty. Throws
// RecoveryError.
void discretise(MeshData& mesh);

// Throws RecoveryError where a chain that is a single point lies outside the domain: no edge of it says so.
void require_points_in_domain(const MeshData& mesh);

// Inserts a boundary point, by a search from `near`; free vertices that are already there give way. Throws
// RecoveryError where another boundary vertex or edge is there.
VertexId insert_boundary_point(Triangulation& triangulation, Point p, VertexId near);

// LS of a non-Steiner vertex (equation LS_b): the distance to its nearest neighbour over R, neighbours on its
// curve and, in the given triangulation, across the domain. Where a neighbour is a Steiner vertex of an older
// boundary, LS(u) + |uv| / G instead (section 3's combined rule). Of a single point, which has no curve, the
// nearest station is looked for where neighbours do not tell: the search goes through the domain's edges,
// nearest vertices first.
enum class Neighbours { all, stations };  // stations: Steiner vertices have no say
double neighbour_length_scale(const MeshData& mesh, std::uint32_t k, Neighbours neighbours = Neighbours::all);

}  // namespace remodel
