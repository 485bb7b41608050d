#pragma once

// Slow and obvious reference versions of the hard steps. They share no code with the library but the point
// type: signs are computed in integers of arbitrary size, and searches are exhaustive.

#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/point.h"

namespace remodel::reference {

// The signs of predicates.h, from the textbook determinants.
int orient(Point a, Point b, Point c);
int incircle(Point a, Point b, Point c, Point d);
// Ties broken by lifting: of the four points, in descending lexicographic order, the first whose lift changes
// the determinant decides.
int incircle_lifted(Point a, Point b, Point c, Point d);

using Edge = std::array<std::size_t, 2>;  // indices of points, ascending
using Face = std::array<std::size_t, 3>;  // counter-clockwise, the smallest first

Edge edge_of(std::size_t a, std::size_t b);
Face face_of(std::size_t a, std::size_t b, std::size_t c);

// The Delaunay triangles: every triple whose circle holds no other point.
std::set<Face> delaunay(const std::vector<Point>& points);

// The constrained Delaunay triangles: edges are added, the constraints first, as long as they cross nothing
// and pass through no point; then every edge that is not locally Delaunay is flipped until there is none.
// Precondition: constraints do not cross and pass through no point.
std::set<Face> constrained_delaunay(const std::vector<Point>& points, const std::set<Edge>& constraints);

// The edges that every constrained Delaunay triangulation of the same points has, however it breaks ties:
// constraints, edges of the hull, and those that have the point across strictly outside the circle.
std::set<Edge> certain_edges(const std::vector<Point>& points, const std::set<Face>& faces,
                             const std::set<Edge>& constraints);

// Triangles of `before` that are in `after` too: the same vertex ids at the same places.
std::size_t preserved(const FrozenMesh& before, const FrozenMesh& after);

}  // namespace remodel::reference
