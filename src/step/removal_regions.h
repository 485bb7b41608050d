#pragma once

// Circular removal regions (the paper's section 3), and the vertices inside them.

#include <span>
#include <vector>

#include "mesh/mesh_data.h"

namespace remodel {

// Every interior vertex strictly inside goes.
struct RemovalRegion {
  Point centre;
  double radius;
  TriangleId hint;  // a triangle near the centre
};

// The interior vertices inside the regions, each once, in the mesh's arena. Changes scratch only. Triangles
// that a disc meets are connected through edges that it meets, so the search from one of them finds them all,
// also where the centre's own triangle has no vertex inside.
List<VertexId> vertices_inside(MeshData& mesh, std::span<const RemovalRegion> regions);

}  // namespace remodel
