#include "flow/scheme/wall_extent.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/disjoint_sets.h"

namespace remodel::flow {

namespace {

bool turns(Point in, Point out) {
  constexpr double least_turn = 1e-4;  // radians: less is a straight line, as files write it
  return dot(in, out) <= 0.0 ||
         std::fabs(cross(in, out)) > least_turn * std::sqrt(dot(in, in) * dot(out, out));
}

// Vertices of walls, or those at which they turn or touch, ascending.
std::vector<std::uint32_t> wall_vertices(std::span<const Point> points, std::span<const BoundaryEdge> edges,
                                         bool bends_alone) {
  std::vector<std::uint32_t> before(points.size(), no_index), after(points.size(), no_index), found;
  std::vector<bool> touching(points.size(), false);
  for (const BoundaryEdge& edge : edges) {
    touching[edge.a] = touching[edge.a] || after[edge.a] != no_index;
    touching[edge.b] = touching[edge.b] || before[edge.b] != no_index;
    after[edge.a] = edge.b, before[edge.b] = edge.a;
  }
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (before[v] == no_index && after[v] == no_index) continue;
    const bool within = before[v] != no_index && after[v] != no_index;
    if (!bends_alone || touching[v] ||
        (within && turns(points[v] - points[before[v]], points[after[v]] - points[v])))
      found.push_back(v);
  }
  return found;
}

// The corners of the convex hull (A. M. Andrew, Inform. Process. Lett. 9 (1979)).
std::vector<std::uint32_t> hull_of(std::span<const Point> points, std::vector<std::uint32_t> vertices) {
  std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Point p = points[i], q = points[j];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : i < j;
  });
  std::vector<std::uint32_t> hull;
  const auto go_round = [&](auto first, auto last) {
    const std::size_t kept = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= kept + 2 && cross(points[hull.back()] - points[hull[hull.size() - 2]],
                                              points[*first] - points[hull.back()]) <= 0.0)
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // begins the other half
  };
  go_round(vertices.begin(), vertices.end());
  go_round(vertices.rbegin(), vertices.rend());
  return hull;
}

Extent largest_extent(std::span<const Point> points, DisjointSets& walls,
                      std::vector<std::uint32_t> vertices) {
  std::stable_sort(vertices.begin(), vertices.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return walls.root(i) < walls.root(j); });
  Extent largest;
  for (auto first = vertices.begin(); first != vertices.end();) {
    const auto last = std::find_if(first, vertices.end(),
                                   [&](std::uint32_t v) { return walls.root(v) != walls.root(*first); });
    const std::vector<std::uint32_t> hull = hull_of(points, {first, last});
    for (std::size_t i = 0; i < hull.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Point d = points[hull[i]] - points[hull[j]];
        const double length = std::sqrt(dot(d, d));
        if (length > largest.length) largest = {length, hull[j], hull[i]};
      }
    first = last;
  }
  return largest;
}

}  // namespace

Extent wall_extent(std::span<const Point> points, std::span<const BoundaryEdge> edges) {
  DisjointSets walls(points.size());  // vertices that walls join to each other
  for (const BoundaryEdge& edge : edges) walls.join(edge.a, edge.b);
  const Extent bends = largest_extent(points, walls, wall_vertices(points, edges, true));
  return bends.length > 0.0 ? bends : largest_extent(points, walls, wall_vertices(points, edges, false));
}

}  // namespace remodel::flow
