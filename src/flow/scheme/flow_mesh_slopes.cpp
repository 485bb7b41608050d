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

// Halves of boundary edges, and dual faces that follow where these meet.
void FlowMesh::add_boundary_slopes(const Slopes& slopes, std::vector<Point>& points) const {
  using Eight = Dual<8>;
  for (std::size_t i = 0; i < boundary_.size(); ++i) {
    const BoundaryEdge& edge = boundary_[i];
    const auto& [by_half, by_edge] = slopes.boundary[i];
    Point by_d = turned_back(0.5 * (by_half[0] + by_half[1]) + by_edge);
    if (patch(edge).bent()) {
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
    Point &from = points[edge.place[0]], &to = points[edge.place[1]];
    from = from - by_d, to = to + by_d;
  }
}

void FlowMesh::add_inner_slopes(const Slopes& slopes, std::vector<Point>& points) const {
  std::vector<double> by_around(size(), 0.0);
  std::vector<Point> by_sum = slopes.weight;  // by the sum before it is divided
  for (std::size_t v = 0; v < size(); ++v)
    for (std::uint32_t i = ring_start_[v]; i < ring_start_[v + 1]; ++i) {
      by_around[v] -= dot(slopes.weight[i], ring_[i].weight) / around_[v];
      by_sum[i] = (1.0 / around_[v]) * slopes.weight[i];
    }
  for (std::size_t t = 0; t < cells_.size(); ++t) {
    const Cell& cell = cells_[t];
    const std::uint32_t n = cell.corners();
    Point p[4], by[4] = {};
    for (std::uint32_t i = 0; i < n; ++i) p[i] = points_[cell[i]];
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n, before = (i + n - 1) % n, after = (j + 1) % n;
      // The area of the triangle before, i, j.
      const std::uint32_t v = original(cell[i]), w = original(cell[j]);
      const double by_area = 0.5 * by_around[v];
      const auto turned = [&](Point d) { return by_area * Point{d.y, -d.x}; };
      by[i] = by[i] + turned(p[j] - p[before]), by[j] = by[j] + turned(p[before] - p[i]);
      by[before] = by[before] + turned(p[i] - p[j]);
      const std::uint32_t e = cell_edges_[t][i];
      const double sign = v == edges_[e].a ? 1.0 : -1.0;
      const Point by_d = sign * turned_back(slopes.normal[e]);
      for (std::uint32_t k = 0; k < n; ++k) by[k] = by[k] + (1.0 / n) * by_d;
      by[i] = by[i] - 0.5 * by_d, by[j] = by[j] - 0.5 * by_d;
      // weights are half of {-side.y, side.x}
      const Point at_i = by_sum[ring_entry(v, e)], at_j = by_sum[ring_entry(w, e)];
      const Point by_side_j = {0.5 * at_i.y, -0.5 * at_i.x}, by_side_i = {0.5 * at_j.y, -0.5 * at_j.x};
      by[i] = by[i] + by_side_j, by[before] = by[before] - by_side_j;
      by[after] = by[after] + by_side_i, by[j] = by[j] - by_side_i;
    }
    for (std::uint32_t i = 0; i < n; ++i) points[cell[i]] = points[cell[i]] + by[i];
  }
}

}  // namespace remodel::flow
