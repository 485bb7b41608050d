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
  // are the caller's to renew, and regions reach to the nearer neighbour, or farther: lost_vertex_radius().
  bool renewing = false;
};

// What a removal region reaches at least: the distance to a boundary neighbour. The paper's radius is the
// larger of this and D * distance of the pair.
double least_radius(const ReplaceOptions& options, Point centre, Point before, Point after);
// The radius about a non-Steiner vertex that could not be moved in place. If that failed although it hardly
// moves, by less than 0.3 of the least radius, a triangle there mostly is at a bound already and would fail
// in many of the steps to come: when renewing, the region reaches at least sqrt(2) times the least radius, so
// that what is tight is made anew. Measured in docs/performance.md.
double lost_vertex_radius(const ReplaceOptions& options, double pair_distance, Point centre, Point before,
                          Point after);

// Makes the triangles outside the domain at all boundary vertices Delaunay again, which full adjustments do
// not.
void restore_outside(MeshData& mesh);

// Inserts a boundary point; an interior vertex that is there already gives way. Throws RecoveryError where a
// boundary vertex is there.
VertexId insert_boundary_point(Triangulation& triangulation, Point p, TriangleId hint);

}  // namespace remodel
