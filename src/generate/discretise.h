#pragma once

#include "mesh/mesh_data.h"

namespace remodel {

// The constrained Delaunay triangulation of a domain's stations, labelled, with length scales: what
// refinement starts from. Precondition: mesh.domain is valid, the rest of mesh is empty. Throws
// RecoveryError.
void discretise(MeshData& mesh);

// LS of a non-Steiner vertex (equation LS_b): the distance to its nearest neighbour over R, neighbours on its
// curve and, in the given triangulation, across the domain. Where a neighbour is a Steiner vertex of an older
// boundary, LS(u) + |uv| / G instead (section 3's combined rule).
enum class Neighbours { all, stations };  // stations: Steiner vertices have no say
double neighbour_length_scale(const MeshData& mesh, std::uint32_t k, Neighbours neighbours = Neighbours::all);

}  // namespace remodel
