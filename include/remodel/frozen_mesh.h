#pragma once

// The compact, frozen view of a mesh: all that files, solvers, pictures and the checker ever see.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "remodel/point.h"

namespace remodel {

struct FrozenBoundary {
  std::string name;
  // Pairs of point indices, the domain on the left of first -> second; in the order of the loop, forwards or
  // backwards (around a hole, the curves' parameters mostly run against the edges).
  std::vector<std::array<std::uint32_t, 2>> edges;
};

struct FrozenMesh {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of the domain, counter-clockwise, 0-based
  std::vector<FrozenBoundary> boundaries;               // one a name

  // Empty, or one value a point or triangle: a mesh of another program has none of these.
  std::vector<double> length_scale;         // per point, chords
  std::vector<std::uint32_t> vertex_ids;    // per point: VertexId in the living mesh
  std::vector<std::uint32_t> triangle_ids;  // per triangle: TriangleId
  std::vector<std::uint32_t> birth;         // per triangle: the remodelling step that made it, 0 = generation
  std::vector<std::int32_t> curve;          // per point: index of its curve in the design, -1 in the interior
  std::vector<double> parameter;            // per point: t on that curve, 0 in the interior
  // Per triangle: ln(r / (H mean LS*)), only where it was asked for (Mesh::gradation_errors()).
  std::vector<double> gradation_error{};
};

}  // namespace remodel
