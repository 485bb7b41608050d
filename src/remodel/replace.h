#pragma once

// Removal and replacement: what both methods share once it is known which vertices go and which come. All of
// it runs under the triangulation's journal.

#include <vector>

#include "generate/refine.h"
#include "generate/relabel.h"
#include "mesh/mesh_data.h"

namespace remodel {

// A circular removal region: every interior vertex strictly inside goes (the paper's section 3).
struct RemovalRegion {
  Point centre;
  double radius;
  TriangleId hint;  // a triangle near the centre
};

// The interior vertices inside the regions, each once. Changes scratch only. Triangles that a disc meets are
// connected through edges that it meets, so the search from the centre's triangle finds them all, also where
// the centre's own triangle has no vertex inside.
std::vector<VertexId> vertices_inside(MeshData& mesh, const std::vector<RemovalRegion>& regions);

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
