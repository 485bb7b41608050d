#pragma once

// Length scales from the triangles of a mesh that has none.

#include "mesh/mesh_data.h"

namespace remodel {

// The largest circumradius over shortest edge of the domain's triangles and of the file's that may be shown
// in their place, squared; infinite where a triangle is so flat that its circle cannot be computed.
double worst_squared_radius_edge(const MeshData& mesh);

// Sets the length scale of every vertex: one and a half times the mean of r / H over its triangles of the
// domain, raised where a triangle would otherwise be too large for its vertices. The mesh's options say H.
void set_length_scales(MeshData& mesh);

// G of a mesh with length scales: such that nine tenths of the edges have scales at their ends that differ by
// no more than length / G. Within 0.1 and 100.
double measured_gradation(const MeshData& mesh);

}  // namespace remodel
