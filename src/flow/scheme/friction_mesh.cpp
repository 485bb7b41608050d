#include "flow/scheme/friction_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace remodel::flow {

namespace {

double squared_distance_to_segment(Point p, Point a, Point b) {
  const Point d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return squared_distance(p, a + t * d);
}

}  // namespace

FrictionMesh::FrictionMesh(const FlowMesh& mesh) : mesh_(mesh) {
  sticks_.assign(mesh.size(), false);
  for (const BoundaryEdge& edge : mesh.boundary())
    if (mesh.patch(edge).sticks()) sticks_[edge.a] = sticks_[edge.b] = true;
  count_cells();
  make_upwind();
  make_triangles();
  measure_distances();
}

void FrictionMesh::count_cells() {
  around_.assign(mesh_.size(), {});
  quads_of_edge_.assign(mesh_.edges().size(), 0);
  edge_cells_.assign(2 * mesh_.edges().size(), no_index);
  const auto edge_between = [&](std::uint32_t a, std::uint32_t b) {
    for (const RingEntry& entry : mesh_.ring(a))
      if (entry.vertex == b) return entry.edge;
    return no_index;
  };
  for (std::uint32_t t = 0; t < mesh_.cells().size(); ++t) {
    const Cell& cell = mesh_.cells()[t];
    const std::uint32_t n = cell.corners();
    for (std::uint32_t i = 0; i < n; ++i) {
      ++(n == 4 ? around_[cell[i]].quads : around_[cell[i]].triangles);
      const std::uint32_t e = edge_between(cell[i], cell[(i + 1) % n]);
      if (n == 4) ++quads_of_edge_[e];
      edge_cells_[2 * e + (edge_cells_[2 * e] == no_index ? 0 : 1)] = t;
    }
  }
  for (const BoundaryEdge& edge : mesh_.boundary())
    around_[edge.a].boundary = around_[edge.b].boundary = true;
}

// The other edge at v that has no cell in common with this one, where four cells of a layer meet, or two at
// its end.
std::uint32_t FrictionMesh::opposite(std::uint32_t v, std::uint32_t edge) const {
  const Around& at = around_[v];
  const bool is_inside = at.quads == 4 && at.triangles == 0 && !at.boundary;
  const bool is_end = at.quads == 2 && quads_of_edge_[edge] == 1;
  if (!is_inside && !is_end) return no_index;
  const auto shares_cell = [&](std::uint32_t e, std::uint32_t f) {
    for (const std::uint32_t c : {edge_cells_[2 * e], edge_cells_[2 * e + 1]})
      if (c != no_index && mesh_.cells()[c].corners() == 4 &&
          (c == edge_cells_[2 * f] || c == edge_cells_[2 * f + 1]))
        return true;
    return false;
  };
  for (const RingEntry& entry : mesh_.ring(v)) {
    if (entry.edge == edge || shares_cell(edge, entry.edge)) continue;
    if (is_end && quads_of_edge_[entry.edge] != 1) continue;
    return entry.vertex;
  }
  return no_index;
}

void FrictionMesh::make_upwind() {
  upwind_start_.assign(1, 0);
  for (std::uint32_t e = 0; e < mesh_.edges().size(); ++e) {
    const DualEdge& edge = mesh_.edges()[e];
    const Point d = mesh_.points()[edge.b] - mesh_.points()[edge.a];
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t here = side == 0 ? edge.a : edge.b, there = side == 0 ? edge.b : edge.a;
      const double sign = side == 0 ? 1.0 : -1.0;
      if (const std::uint32_t behind = opposite(here, e); behind != no_index) {
        const double ratio =
            std::sqrt(dot(d, d) / squared_distance(mesh_.points()[here], mesh_.points()[behind]));
        upwind_.push_back({here, sign * ratio});
        upwind_.push_back({behind, -sign * ratio});
      } else if (around_[here].triangles == 0 || mesh_.one_sided(here)) {
        upwind_.push_back({there, sign});
        upwind_.push_back({here, -sign});
      } else {
        double own = sign;
        for (const RingEntry& entry : mesh_.ring(here)) {
          const double weight = 2.0 * dot(entry.weight, d);
          own -= weight;
          upwind_.push_back({entry.vertex, weight - (entry.vertex == there ? sign : 0.0)});
        }
        upwind_.push_back({here, own});
      }
      upwind_start_.push_back(static_cast<std::uint32_t>(upwind_.size()));
    }
  }
}

void FrictionMesh::make_triangles() {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, bool is_cell) {
    const Point p[3] = {mesh_.points()[a], mesh_.points()[b], mesh_.points()[c]};
    const double twice = cross(p[1] - p[0], p[2] - p[0]);
    CornerTriangle triangle = {
        .corner = {a, b, c}, .slope = {}, .area = is_cell ? 0.5 * twice : 0.25 * twice, .share = {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point side = p[(i + 2) % 3] - p[(i + 1) % 3];
      triangle.slope[i] = (1.0 / twice) * Point{-side.y, side.x};
      triangle.share[i] = is_cell ? triangle.area / 3.0 : i == 0 ? triangle.area : 0.0;
    }
    triangles_.push_back(triangle);
  };
  for (const Cell& cell : mesh_.cells()) {
    const std::uint32_t n = cell.corners();
    if (n == 3)
      add(cell[0], cell[1], cell[2], true);
    else
      for (std::uint32_t i = 0; i < n; ++i) add(cell[i], cell[(i + 1) % n], cell[(i + 3) % n], false);
  }
}

// The distance from every segment: exact, and quick beside one Jacobian.
void FrictionMesh::measure_distances() {
  distance_.assign(mesh_.size(), std::numeric_limits<double>::infinity());
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    if (!mesh_.patch(edge).sticks()) continue;
    const Point a = mesh_.points()[edge.a], b = mesh_.points()[edge.b];
    for (std::size_t v = 0; v < mesh_.size(); ++v)
      distance_[v] = std::min(distance_[v], squared_distance_to_segment(mesh_.points()[v], a, b));
  }
  for (std::size_t v = 0; v < mesh_.size(); ++v) distance_[v] = sticks_[v] ? 0.0 : std::sqrt(distance_[v]);
}

}  // namespace remodel::flow
