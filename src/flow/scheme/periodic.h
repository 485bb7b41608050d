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

// A boundary and the one that it is when it is moved.
struct PeriodicPairing {
  std::string names;  // of both, for messages
  Point period;       // from the first to the moved one: the mean over all images
  std::vector<std::uint32_t> images;
};

struct PeriodicVertices {
  std::vector<std::uint32_t> original;  // of each vertex, itself where it is no image; empty: there are none
  std::vector<std::uint32_t> counterpart;  // likewise; of an image its original, and the other way round
  std::vector<PeriodicPairing> pairs;

  // Whether the vertex lies on a periodic boundary.
  bool at(std::uint32_t v) const { return !counterpart.empty() && counterpart[v] != v; }
  // The same vertices at other places. Throws Error (argument) naming `source` where a boundary is not the
  // other one moved any more.
  void move(std::span<const Point> points, const std::string& source);
};

// Throws Error (argument) naming `source` where one boundary of a pair is not the other one moved, vertex for
// vertex.
PeriodicVertices periodic_vertices(std::span<const Point> points,
                                   const std::vector<FrozenBoundary>& boundaries,
                                   const std::vector<Patch>& patches, const std::string& source);

}  // namespace remodel::flow
