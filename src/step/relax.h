#pragma once

// Relaxation: single vertices of the interior are moved until triangles keep their angles and edges are
// Delaunay. It mends what a morph has spoilt by a little, with all triangles joined as they were, before
// anything is flipped or refined. morph.h tells the method.

#include "mesh/mesh_data.h"

namespace remodel {

// Looks at the triangles in the domain among those given. Requires and preserves: counter-clockwise,
// circumcircles current. Appends the triangles that moved, some of them more than once. Returns whether
// nothing that it looked at misses its bound.
bool relax(MeshData& mesh, const QualityBounds& bounds, List<TriangleId>& triangles);

}  // namespace remodel
