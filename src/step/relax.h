#pragma once

// Single vertices of the interior are moved so that triangles keep their angles and edges stay Delaunay: what
// a morph has spoilt by a little is mended with all triangles joined as they were, before anything is
// flipped or refined.
//
// Each vertex goes downhill on the sum of max(0, m - s)^2 over what its place decides: s is how far a
// triangle of its star is from its bound on radius and edge, and how far the two angles opposite an edge of
// the star or its rim are from 180 degrees, by their cotangents, whose sum is positive where the edge is
// Delaunay. As these are all terms that change, the sum over the whole mesh falls with each move. Local
// optimisation of element quality: L. A. Freitag and C. Ollivier-Gooch, "Tetrahedral mesh improvement using
// swapping and smoothing", Int. J. Numer. Meth. Engng 40, 1997.

#include "mesh/mesh_data.h"

namespace remodel {

// Of the triangles in the domain among those given, which are counter-clockwise and have the right circles:
// that stays so. Triangles that moved are appended, some of them again. False where something still misses
// its bound.
bool relax(MeshData& mesh, const QualityBounds& bounds, List<TriangleId>& triangles);

}  // namespace remodel
