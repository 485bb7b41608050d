#pragma once

// How large walls are: the length that the limiter compares edges with.

#include <span>

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// The largest distance between two bends of one connected wall: the chord of a section, also where the wall
// goes on straight beside it (half a section on a line of symmetry), and that of the largest one where there
// are several. Where no wall bends (a straight duct), that between two points of one. It turns and grows
// with the mesh. Without a wall: 0.
Extent wall_extent(std::span<const Point> points, std::span<const BoundaryEdge> edges);

}  // namespace remodel::flow
