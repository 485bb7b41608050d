#include "check/exemption.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace remodel::checker {
namespace {

constexpr double equal_distance = 1e-6;  // relative; the next split of a side lies at twice the distance
constexpr int longest_walk = 1000;       // points along one side

double squared_length(Point p) {
  return p.x * p.x + p.y * p.y;
}

// Between the layer on a wall and the triangles beyond it. Quadrilaterals of another program's mesh, which
// has no keys, are no layer.
bool is_top(const FrozenMesh& mesh, const Edge& edge) {
  if (mesh.vertex_keys.empty()) return false;
  const auto is_layer = [&](std::uint32_t cell) {
    return cell < mesh.layer_triangles || cell >= mesh.triangles.size();
  };
  return !edge.is_boundary() && is_layer(edge.left) != is_layer(edge.right);
}

}  // namespace

Exemption::Exemption(const FrozenMesh& mesh, const Topology& topology,
                     const std::vector<std::uint32_t>& name_of_edge)
    : mesh_(mesh), neighbours_(mesh.points.size()), corners_(mesh.points.size()) {
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const Edge& edge = topology.edges()[e];
    if (!edge.is_boundary() && name_of_edge[e] == none && !is_top(mesh, edge)) continue;
    neighbours_[edge.from].push_back(edge.to);
    neighbours_[edge.to].push_back(edge.from);
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
    if (neighbours_[v].size() >= 2) find_corner(v, topology);
}

Point Exemption::direction(std::uint32_t from, std::uint32_t to) const {
  return mesh_.points[to] - mesh_.points[from];
}

// The wedges between boundary edges that follow each other around v, where the domain fills them.
void Exemption::find_corner(std::uint32_t v, const Topology& topology) {
  std::vector<std::uint32_t> around = neighbours_[v];
  const auto angle = [&](std::uint32_t u) { return std::atan2(direction(v, u).y, direction(v, u).x); };
  std::sort(around.begin(), around.end(),
            [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::uint32_t a = around[i], b = around[(i + 1) % around.size()];
    const Point u = direction(v, a), w = direction(v, b);
    const double product = u.x * w.x + u.y * w.y;
    const bool small = cross(u, w) > 0.0 && product > 0.5 * std::sqrt(squared_length(u) * squared_length(w));
    if (!small) continue;
    const Edge& edge = topology.edges()[topology.find(v, a)];
    if (edge.from == v || !edge.is_boundary()) corners_[v].push_back({a, b});
  }
}

// The nearest corner along each boundary edge of v.
std::vector<Exemption::Reached> Exemption::corners_from(std::uint32_t v) const {
  std::vector<Reached> result;
  for (const std::uint32_t first : neighbours_[v]) {
    std::uint32_t before = v, here = first;
    for (int steps = 0; corners_[here].empty() && neighbours_[here].size() == 2 && steps < longest_walk;
         ++steps) {
      const std::uint32_t next = neighbours_[here][0] == before ? neighbours_[here][1] : neighbours_[here][0];
      before = std::exchange(here, next);
    }
    if (!corners_[here].empty()) result.push_back({here, before});
  }
  return result;
}

bool Exemption::exempts(std::uint32_t triangle) const {
  const auto& corners = mesh_.triangles[triangle];
  std::size_t shortest = 0;
  const auto length = [&](std::size_t k) {
    return squared_length(direction(corners[k], corners[(k + 1) % 3]));
  };
  for (std::size_t k = 1; k < 3; ++k)
    if (length(k) < length(shortest)) shortest = k;
  const std::uint32_t a = corners[shortest], b = corners[(shortest + 1) % 3];
  const std::vector<Reached> from_a = corners_from(a), from_b = corners_from(b);
  for (const Reached& one : from_a)
    for (const Reached& other : from_b) {
      if (one.corner != other.corner) continue;
      const double da = squared_length(direction(one.corner, a)),
                   db = squared_length(direction(one.corner, b));
      if (std::abs(da - db) > equal_distance * (da + db)) continue;
      for (const auto& [left, right] : corners_[one.corner])
        if ((left == one.along && right == other.along) || (left == other.along && right == one.along))
          return true;
    }
  return false;
}

}  // namespace remodel::checker
