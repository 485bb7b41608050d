#pragma once

// The rules on boundaries and on the design; those on single triangles, edges and vertices are in check.cpp.

#include <cstdint>
#include <memory>
#include <vector>

#include "check/exact_points.h"
#include "check/report.h"
#include "check/topology.h"
#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"

namespace remodel::checker {

// A mesh with valid indices and finite coordinates, and what is derived from it.
struct Subject {
  const FrozenMesh& mesh;
  const Topology& topology;
  const ExactPoints& exact;
  std::vector<std::uint32_t> name_of_edge;  // per edge of the topology: index of its boundary, or none
  std::vector<bool> joints;  // per point: whether chains of the design are joined there; may be empty

  bool is_joint(std::uint32_t v) const { return !joints.empty() && joints[v]; }
  const char* cells_name() const { return mesh.quads.empty() ? "triangles" : "cells"; }
};

// Twice the area of a cell, with its sign.
ExactPoints::Integer twice_area(const ExactPoints& exact, Corners cell);

// Rule "boundary", first part: every named edge is an edge of the mesh, named once, with the domain on its
// left. Edges with a cell on both sides may be named: internal constraints. Returns
// Subject::name_of_edge.
std::vector<std::uint32_t> name_edges(const FrozenMesh& mesh, const Topology& topology, Report& report);

// Rule "boundary", second part: every edge with a cell on one side only is named.
void check_names_are_complete(const Subject& subject, Report& report);

// Rule "boundary", third part: under each name, the edges of one loop are in the order of the loop; where
// loops touch, those between two such points. Needs the fans of every vertex to be as they should.
void check_order_of_names(const Subject& subject, Report& report);

// Rule "area": the cells' areas sum up to that of the named polygons, exactly.
void check_area(const Subject& subject, Report& report);

// Rule "overlap": no two boundary edges meet except at a common vertex, and on the left of every loop the
// domain is covered once. Where all cells are convex and counter-clockwise and every vertex has one fan, this
// proves that cells do not overlap: the number of cells over a place is the sum of the loops' winding
// numbers around it, which changes across loops only.
void check_overlap(const Subject& subject, Report& report);

// The points where several edges of the boundary begin: there its loops touch.
std::vector<bool> points_of_several_loops(const Topology& topology, const FrozenMesh& mesh);

// The points where several loops and chains of the design have a station.
std::vector<bool> joints_of(const FrozenMesh& mesh, const Domain& design);

// Rule "design": boundary vertices are exactly the design's points at their curve and parameter, every
// station of the design is there, and the edges of each loop join consecutive parameters, under the curve's
// name and with the domain on the sides that the loop's role asks for.
void check_design(const Subject& subject, const Domain& design, double rounding, Report& report);

}  // namespace remodel::checker
