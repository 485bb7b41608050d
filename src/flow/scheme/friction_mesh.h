#pragma once

// What flows with friction need of a mesh beside its dual: upwind differences that go straight on along
// layers of quadrilaterals, triangles that gradients are constant on, distances from walls.
//
// Upwind differences by gradients of vertices fail on curved layers, whose edges are longer than their cells
// are high by orders of magnitude: off by (du/dn) s^2 / 2R there, many cells' jumps. The *opposite neighbour*
// of a vertex, straight behind it as seen along an edge, is a matter of topology:
//
//        |     |     |      At v, among quadrilaterals alone, b is opposite to w, and c to d. At the end
//     ---c-----+-----+---   of a layer, where two quadrilaterals meet the edge to d, b is still opposite to
//        |     |     |      w, and d has no opposite neighbour. Other vertices take gradients. On walls,
//     ---v-----w-----+---   whose gradients are one-sided, and where b is very near, the upwind difference
//    /   |     |     |      is the central one.
//   b    d     |     |

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// Where on the segment from a to b p is nearest to, from 0 to 1.
double nearest_part(Point p, Point a, Point b);

struct WeightedVertex {
  std::uint32_t vertex;
  double weight;
};

// The triangle of a triangular cell, or of a corner of a quadrilateral and its two neighbours: the mean over
// all four is exact for linear functions, and on a rectangle a scheme of edges alone.
template <class T>
struct TriangleShape {
  PlaneVector<T> slope[3];  // gradients of the hat functions
  T area;                   // what it counts for: its own, or half of that where it is of a quadrilateral
  T share[3];               // of the area, for sources: which vertex they belong to
  PlaneVector<T> face[3];   // of the corners' dual cells in the triangle, inwards; also along outlets
  TriangleShape(const std::array<PlaneVector<T>, 3>& p, bool of_quad, const std::array<bool, 3>& outlet);
};
struct CornerTriangle : TriangleShape<double> {
  std::uint32_t corner[3];
  std::uint32_t place[3];  // where these lie: themselves, or images of them
  bool of_quad;
  std::array<bool, 3> outlet;  // of the edges opposite to corners, where friction acts across the boundary
};

template <class T>
TriangleShape<T>::TriangleShape(const std::array<PlaneVector<T>, 3>& p, bool of_quad,
                                const std::array<bool, 3>& outlet) {
  const T twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  area = (of_quad ? 0.25 : 0.5) * twice;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlaneVector<T>&from = p[(i + 1) % 3], &to = p[(i + 2) % 3];
    slope[i] = {(from.y - to.y) / twice, (to.x - from.x) / twice};
    share[i] = !of_quad ? (1.0 / 3.0) * area : i == 0 ? area : T(0.0);
    face[i] = {area * slope[i].x, area * slope[i].y};
  }
  // The halves of an edge of an outlet are faces, too.
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::size_t i : {(k + 1) % 3, (k + 2) % 3})
      if (outlet[k]) face[i] = {face[i].x + area * slope[k].x, face[i].y + area * slope[k].y};
}

// What the turbulence model knows of a vertex.
template <class T>
struct WallPlace {
  T distance;  // from walls that gas sticks to
  bool is_laminar = false;
};

class FrictionMesh {
 public:
  // transition: of upper and lower sides, chord fractions; none: turbulent from the leading edge on.
  explicit FrictionMesh(const FlowMesh& mesh, const std::optional<std::array<double, 2>>& transition = {});

  const FlowMesh& dual() const { return mesh_; }
  // The upwind difference over edge `e` at its first (0) or second end, over the edge's length and in its
  // direction: the sum of weights times values. The weights' sum is 0.
  std::span<const WeightedVertex> upwind(std::size_t e, std::size_t side) const {
    const std::size_t i = 2 * e + side;
    return {upwind_.data() + upwind_start_[i], upwind_start_[i + 1] - upwind_start_[i]};
  }
  // What that difference is made of: `behind`, the opposite neighbour, where there is one, and else the
  // difference itself (central) or the gradient.
  enum class Upwind : std::uint8_t { opposite, central, gradient };
  struct UpwindKind {
    Upwind kind;
    std::uint32_t behind = no_index, edge_behind = no_index;  // and the edge to it
  };
  UpwindKind upwind_kind(std::size_t e, std::size_t side) const { return kinds_[2 * e + side]; }
  const std::vector<CornerTriangle>& triangles() const { return triangles_; }
  // What triangles share out to a vertex; its mean gradient over that is the sum over ring() of these weights
  // times (value there - value here).
  double area(std::size_t v) const { return area_[v]; }
  std::span<const Point> mean_gradient(std::size_t v) const {
    return {mean_gradient_.data() + mesh_.ring_begin(v), mesh_.ring(v).size()};
  }
  // Adds derivatives of a function by coordinates, given those by distances.
  void add_distance_slopes(const std::vector<double>& by_distance, std::vector<Point>& points) const;
  // From walls that gas sticks to, also those that periods move them to.
  const std::vector<double>& distances() const { return distance_; }
  bool sticks(std::size_t v) const { return sticks_[v]; }
  // The boundary edge of such walls that is nearest, of each vertex; no_index: there is none.
  const std::vector<std::uint32_t>& nearest() const { return nearest_; }
  // Where the vertex lies to be that near: its own place, or that moved by a period.
  Point nearest_from(std::size_t v) const { return moved(v, turns_[v]); }
  // Before the transition. Derivatives by the shape hold it.
  bool is_laminar(std::size_t v) const { return !laminar_.empty() && laminar_[v]; }

 private:
  // How often which pair's period moves a vertex to where it is nearest to a wall.
  struct Turns {
    std::uint32_t pair = 0;
    int count = 0;
  };
  struct Around {
    std::uint8_t quads = 0, triangles = 0;
    bool boundary = false;
  };
  const RingEntry* opposite(std::uint32_t v, std::uint32_t edge) const;
  void count_cells();
  void make_upwind();
  void make_triangles();
  void make_mean_gradients();
  void measure_distances();
  std::vector<Turns> possible_turns() const;
  Point moved(std::size_t v, Turns turns) const;

  const FlowMesh& mesh_;
  std::vector<Around> around_;               // each vertex
  std::vector<std::uint8_t> quads_of_edge_;  // how many meet there
  std::vector<std::uint32_t> edge_cells_;    // two cells each, no_index: none
  std::vector<std::uint32_t> upwind_start_;
  std::vector<WeightedVertex> upwind_;
  std::vector<UpwindKind> kinds_;
  std::vector<CornerTriangle> triangles_;
  std::vector<double> area_;
  std::vector<Point> mean_gradient_;  // as the rings of all vertices, one after the other
  std::vector<double> distance_;
  std::vector<std::uint32_t> nearest_;
  std::vector<Turns> turns_;
  std::vector<bool> sticks_;
  std::vector<bool> laminar_;  // empty: none is
};

}  // namespace remodel::flow
