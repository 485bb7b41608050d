#pragma once

// Removal and replacement: what both methods share once it is known which vertices go and which come. All of
// it runs under the triangulation's journal.

#include <span>
#include <vector>

#include "generate/refine.h"
#include "generate/relabel.h"
#include "mesh/mesh_data.h"
#include "step/removal_regions.h"

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
// The radius about a non-Steiner vertex that could not be moved in place: more than the least when renewing,
// where the vertex hardly moves (RenewPolicy::tight_motion).
double lost_vertex_radius(const ReplaceOptions& options, double pair_distance, Point centre, Point before,
                          Point after);

// Makes the hull convex, and the triangles outside the domain Delaunay, which full adjustments do not: those
// at all boundary vertices but the ones that are marked in mesh.seen_vertices, or that join one. Nothing is
// left to do where mesh.outside_restored says so. Throws RecoveryError where the hull crosses itself.
void restore_outside(MeshData& mesh);
// Whether the domain has a single outer loop, and it is among these. Where it is straight, triangles between
// it and the hull turn over as soon as it moves, and would stand in the way of steps that keep connectivity:
// open_hull() takes them off. With several outer loops the hull would touch itself, and not be restored.
bool moves_outermost(const MeshData& mesh, std::span<const std::size_t> moving);
void open_hull(MeshData& mesh);
bool hull_is_open(const MeshData& mesh);

}  // namespace remodel
