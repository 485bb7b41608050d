#pragma once

// Meshes as another program would have made them.

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "remodel/frozen_mesh.h"
#include "remodel/generate.h"
#include "remodel/predicates.h"
#include "step/test_designs.h"

namespace remodel::test {

// What a file holds of a mesh.
inline FrozenMesh bare(const FrozenMesh& mesh) {
  return {.points = mesh.points,
          .triangles = mesh.triangles,
          .boundaries = mesh.boundaries,
          .length_scale = {},
          .vertex_ids = {},
          .triangle_ids = {},
          .birth = {},
          .curve = {},
          .parameter = {}};
}

inline FrozenMesh foreign(const Domain& domain, const QualityOptions& options = {.gradation = 2.0}) {
  return bare(generate(domain, options).mesh.freeze());
}

inline FrozenMesh foreign_airfoil(int points = 40, std::size_t airfoil = 0) {
  return foreign(airfoil_domain(airfoil_catalogue()[airfoil].airfoil(),
                                {.points = points, .farfield_radius = 4, .farfield_points = 20}));
}

inline FrozenMesh foreign_holes() {
  return foreign(with_holes({star_hole(0.3, 0.3, 0.15), circle_hole(0.7, 0.6, 0.1)}));
}

// Squares, each with one of its diagonals: every edge is a tie.
inline FrozenMesh grid(std::uint32_t n, std::mt19937_64& random) {
  FrozenMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.points.push_back({static_cast<double>(j), static_cast<double>(i)});
  const auto at = [n](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
      if (random() % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  FrozenBoundary south{"south", {}}, rest{"rest", {}};
  for (std::uint32_t k = 0; k < n; ++k) {
    south.edges.push_back({at(0, k), at(0, k + 1)});
    rest.edges.push_back({at(k, n), at(k + 1, n)});
    rest.edges.push_back({at(n, k), at(n, k + 1)});  // against the outline
    rest.edges.push_back({at(k + 1, 0), at(k, 0)});
  }
  mesh.boundaries = {rest, south};
  return mesh;
}

// Flips edges at random where that leaves counter-clockwise triangles.
inline void flip_at_random(FrozenMesh& mesh, int times, std::mt19937_64& random) {
  for (int i = 0; i < times; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> left;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) left[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
    const std::size_t t = random() % mesh.triangles.size(), k = random() % 3;
    const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3],
                        c = mesh.triangles[t][(k + 2) % 3];
    const auto other = left.find({b, a});
    if (other == left.end()) continue;
    std::uint32_t d = a;
    for (const std::uint32_t v : mesh.triangles[other->second])
      if (v != a && v != b) d = v;
    const auto& p = mesh.points;
    if (orient2d(p[a], p[d], p[c]) <= 0 || orient2d(p[d], p[b], p[c]) <= 0) continue;
    mesh.triangles[t] = {a, d, c};
    mesh.triangles[other->second] = {d, b, c};
  }
}

// Triangles by the coordinates of their corners.
using Corners = std::array<std::pair<double, double>, 3>;
inline Corners corners(const FrozenMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  Corners result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = {mesh.points[triangle[k]].x, mesh.points[triangle[k]].y};
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}
inline std::set<Corners> all_corners(const FrozenMesh& mesh) {
  std::set<Corners> result;
  for (const auto& triangle : mesh.triangles) result.insert(corners(mesh, triangle));
  return result;
}

}  // namespace remodel::test
