// The transposed derivatives of FlowMesh::measure(), by hand.

#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

namespace {

// An edge vector turned to its outer normal, {d.y, -d.x}, transposed.
Point turned_back(Point by_normal) {
  return {-by_normal.y, by_normal.x};
}

}  // namespace

void FlowMesh::add_slopes(const Slopes& slopes, std::vector<Point>& points) const {
  add_boundary_slopes(slopes, points);
  if (!slopes.weight.empty()) add_inner_slopes(slopes, points);
}

// Of the halves of boundary edges and of the dual faces that follow where these meet.
void FlowMesh::add_boundary_slopes(const Slopes& slopes, std::vector<Point>& points) const {
  using Eight = Dual<8>;
  for (std::size_t i = 0; i < boundary_.size(); ++i) {
    const BoundaryEdge& edge = boundary_[i];
    const auto& [by_half, by_edge] = slopes.boundary[i];
    Point by_d = turned_back(0.5 * (by_half[0] + by_half[1]) + by_edge);
    if (patch(edge).solid()) {
      Point by_turn = by_half[1] - by_half[0];
      if (!slopes.normal.empty()) {
        const double sign = edge.a == edges_[links_[i].edge].a ? 1.0 : -1.0;
        by_turn = by_turn + sign * slopes.normal[links_[i].edge];
      }
      const Eight turn = bulge<Eight>(i);
      const double by_bulge = dot(by_turn, points_[edge.b] - points_[edge.a]);
      const std::uint32_t corners[4] = {links_[i].before, edge.a, edge.b, links_[i].after};
      for (std::size_t k = 0; k < 4; ++k)
        if (corners[k] != no_index)
          points[corners[k]] =
              points[corners[k]] + by_bulge * Point{turn.slope[2 * k], turn.slope[2 * k + 1]};
      by_d = by_d + turn.value * by_turn;
    }
    points[edge.a] = points[edge.a] - by_d, points[edge.b] = points[edge.b] + by_d;
  }
}

void FlowMesh::add_inner_slopes(const Slopes& slopes, std::vector<Point>& points) const {
  std::vector<double> by_around(size(), 0.0);
  std::vector<Point> by_sum = slopes.weight;  // by the sum before it is divided
  for (std::size_t v = 0; v < size(); ++v) {
    const double around = 3.0 * areas_[v];
    for (std::uint32_t i = ring_start_[v]; i < ring_start_[v + 1]; ++i) {
      by_around[v] -= dot(slopes.weight[i], ring_[i].weight) / around;
      by_sum[i] = (1.0 / around) * slopes.weight[i];
    }
  }
  const auto entry_of = [&](std::uint32_t v, std::uint32_t edge) {
    std::uint32_t i = ring_start_[v];
    while (ring_[i].edge != edge) ++i;
    return i;
  };
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& corners = triangles_[t];
    const Point p[3] = {points_[corners[0]], points_[corners[1]], points_[corners[2]]};
    const double by_area = by_around[corners[0]] + by_around[corners[1]] + by_around[corners[2]];
    Point by[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      by[i] = by[i] + (0.5 * by_area) * Point{p[j].y - p[k].y, p[k].x - p[j].x};
      const std::uint32_t e = triangle_edges_[t][i];
      const double sign = corners[i] == edges_[e].a ? 1.0 : -1.0;
      const Point by_d = sign * turned_back(slopes.normal[e]);
      for (Point& corner : by) corner = corner + (1.0 / 3.0) * by_d;
      by[i] = by[i] - 0.5 * by_d, by[j] = by[j] - 0.5 * by_d;
      // weights are half of {-side.y, side.x}
      const Point at_i = by_sum[entry_of(corners[i], e)], at_j = by_sum[entry_of(corners[j], e)];
      const Point by_side_j = {0.5 * at_i.y, -0.5 * at_i.x}, by_side_i = {0.5 * at_j.y, -0.5 * at_j.x};
      by[i] = by[i] + by_side_j, by[k] = by[k] - by_side_j;
      by[k] = by[k] + by_side_i, by[j] = by[j] - by_side_i;
    }
    for (std::size_t i = 0; i < 3; ++i) points[corners[i]] = points[corners[i]] + by[i];
  }
}

}  // namespace remodel::flow
