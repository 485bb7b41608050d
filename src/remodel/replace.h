#pragma once

// Removal and replacement: what both methods share once it is known which vertices go and which come. All of
// it runs under the triangulation's journal.

#include <vector>

#include "generate/refine.h"
#include "generate/relabel.h"
#include "mesh/mesh_data.h"
#include "remodel/removal_regions.h"

namespace remodel {

struct ReplaceOptions {
  double distance = 1.0;  // D
  // False, the paper's: new boundary vertices take length scales from what is around them too, and removal
  // regions reach to the farther boundary neighbour. True: the curves alone decide length scales, all others
  // are the caller's to renew, and regions reach to the nearer neighbour.
  bool renewing = false;
};

// The radius of a region: max(D * distance of the pair, distance to a boundary neighbour).
double removal_radius(const ReplaceOptions& options, double pair_distance, Point centre, Point before,
                      Point after);

// Makes the triangles outside the domain at all boundary vertices Delaunay again, which full adjustments do
// not.
void restore_outside(MeshData& mesh);

// Inserts a boundary point; an interior vertex that is there already gives way. Throws RecoveryError where a
// boundary vertex is there.
VertexId insert_boundary_point(Triangulation& triangulation, Point p, TriangleId hint);

}  // namespace remodel
