#pragma once

// What flows with friction need of a mesh beside its dual: upwind differences that go straight on along
// layers of quadrilaterals, triangles that gradients are constant on, distances from walls.
//
// Upwind differences by gradients of vertices fail on curved layers, whose edges are longer than their cells
// are high by orders of magnitude: off by (du/dn) s^2 / 2R there, many cells' jumps. The *opposite neighbour*
// of a vertex, straight behind it as seen along an edge, is a matter of topology:
//
//        |     |     |              At v, among quadrilaterals alone, b is opposite to w, and c to d. At the
//        end of
//     ---c-----+-----+---           a layer, where two quadrilaterals meet the edge to d, b is still opposite
//     to w,
//        |     |     |              and d has no opposite neighbour. Other vertices take gradients; on walls,
//        whose
//     ---v-----w-----+---           gradients are one-sided, the upwind difference is the central one.
//    /   |     |     |
//   b    d     |     |

#include <cstdint>
#include <span>
#include <vector>

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

struct WeightedVertex {
  std::uint32_t vertex;
  double weight;
};

// The triangle of a triangular cell, or of a corner of a quadrilateral and its two neighbours: the mean over
// all four is exact for linear functions, and on a rectangle a scheme of edges alone.
struct CornerTriangle {
  std::uint32_t corner[3];
  Point slope[3];   // gradients of the hat functions
  double area;      // what it counts for: its own, or half of that where it is of a quadrilateral
  double share[3];  // of the area, for sources: which vertex they belong to
};

class FrictionMesh {
 public:
  explicit FrictionMesh(const FlowMesh& mesh);

  const FlowMesh& dual() const { return mesh_; }
  // The upwind difference over edge `e` at its first (0) or second end, over the edge's length and in its
  // direction: the sum of weights times values. The weights' sum is 0.
  std::span<const WeightedVertex> upwind(std::size_t e, std::size_t side) const {
    const std::size_t i = 2 * e + side;
    return {upwind_.data() + upwind_start_[i], upwind_start_[i + 1] - upwind_start_[i]};
  }
  const std::vector<CornerTriangle>& triangles() const { return triangles_; }
  const std::vector<double>& distances() const { return distance_; }  // from walls that gas sticks to
  bool sticks(std::size_t v) const { return sticks_[v]; }

 private:
  struct Around {
    std::uint8_t quads = 0, triangles = 0;
    bool boundary = false;
  };
  std::uint32_t opposite(std::uint32_t v, std::uint32_t edge) const;
  void count_cells();
  void make_upwind();
  void make_triangles();
  void measure_distances();

  const FlowMesh& mesh_;
  std::vector<Around> around_;               // each vertex
  std::vector<std::uint8_t> quads_of_edge_;  // how many meet there
  std::vector<std::uint32_t> edge_cells_;    // two cells each, no_index: none
  std::vector<std::uint32_t> upwind_start_;
  std::vector<WeightedVertex> upwind_;
  std::vector<CornerTriangle> triangles_;
  std::vector<double> distance_;
  std::vector<bool> sticks_;
};

}  // namespace remodel::flow
