#pragma once

// Which vertices of a mesh are the same one by periodic boundaries. A vertex of the moved boundary is the
// *image* of its *original*: faces, gradients and cells belong to the original, and the image's unknowns are
// the original's, by equations that say so (image_rows.h).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "flow/physics/boundary/patch.h"
#include "remodel/frozen_mesh.h"
#include "remodel/point.h"

namespace remodel::flow {

struct PeriodicVertices {
  std::vector<std::uint32_t> original;  // of each vertex, itself where it is no image; empty: there are none
  std::vector<std::uint32_t> counterpart;  // likewise; of an image its original, and the other way round
  std::vector<bool> at;                    // whether a vertex lies on a periodic boundary, likewise
  std::vector<Point> periods;              // from each first boundary to its moved one
};

// Throws Error (argument) naming `source` where one boundary of a pair is not the other one moved, vertex for
// vertex.
PeriodicVertices periodic_vertices(std::span<const Point> points,
                                   const std::vector<FrozenBoundary>& boundaries,
                                   const std::vector<Patch>& patches, const std::string& source);

}  // namespace remodel::flow
