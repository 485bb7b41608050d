#pragma once

// What a layered mesh has to be, found out from its frozen view alone, and domains to try.

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "remodel/layers.h"
#include "remodel/predicates.h"

namespace remodel::test {

// Empty, or why the view is no mesh of the walls: a cell is not strictly convex (exactly), an edge is not in
// exactly two cells that pass it in opposite directions, or in one and named; areas do not sum up to the polygons'.
inline std::string why_no_mesh(const FrozenMesh& mesh, const Domain& walls) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double area = 0.0;
  std::vector<std::vector<std::uint32_t>> cells;
  for (const auto& t : mesh.triangles) cells.push_back({t.begin(), t.end()});
  for (const auto& q : mesh.quads) cells.push_back({q.begin(), q.end()});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& cell = cells[i];
    const auto at = [&](std::size_t k) { return mesh.points[cell[k % cell.size()]]; };
    for (std::size_t k = 0; k < cell.size(); ++k) {
      if (orient2d(at(k), at(k + 1), at(k + 2)) <= 0) return "cell " + std::to_string(i) + " is not convex";
      if (++edges[{cell[k], cell[(k + 1) % cell.size()]}] > 1) return "an edge of cell " + std::to_string(i) + " twice";
      area += 0.5 * cross(at(k) - at(0), at(k + 1) - at(0));
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> named;
  for (const FrozenBoundary& boundary : mesh.boundaries)
    for (const auto& edge : boundary.edges)
      if (++named[{edge[0], edge[1]}] > 1) return "a boundary edge twice";
  for (const auto& [edge, count] : edges) {
    const bool inner = edges.contains({edge.second, edge.first});
    if (inner == named.contains(edge))
      return "edge " + std::to_string(edge.first) + " " + std::to_string(edge.second) + " is in one cell, or named inside";
    named.erase(edge);
  }
  if (!named.empty()) return "a boundary edge of no cell";
  double expected = 0.0;
  for (std::size_t l = 0; l < walls.loops.size(); ++l)
    if (!walls.loops[l].open && walls.loops[l].role != LoopRole::internal)
      expected += (walls.loops[l].role == LoopRole::outer ? 1.0 : -1.0) * std::abs(signed_area(walls, l));
  // The outer loop may have Steiner points on arcs: its polygon is larger then.
  if (!(area >= expected * (1.0 - 1e-9)) || !(area <= expected * 1.02))
    return "area " + std::to_string(area) + ", expected " + std::to_string(expected);
  return {};
}

// A square of lines around everything, whose area no Steiner point changes.
inline Loop box(double half, const std::string& name = "farfield") {
  const Point a{-half, -half}, b{half, -half}, c{half, half}, d{-half, half};
  Loop loop{.role = LoopRole::outer, .curves = {}};
  const Parameters parameters = Parameters::uniform(8);
  for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}})
    loop.curves.push_back({.name = name, .shape = Line{from, to}, .parameters = parameters});
  return loop;
}

// A polygon as lines.
inline Loop polygon(const std::vector<Point>& points, const std::string& name = "airfoil") {
  Loop loop{.role = LoopRole::hole, .curves = {}};
  for (std::size_t i = 0; i < points.size(); ++i)
    loop.curves.push_back(
        {.name = name, .shape = Line{points[i], points[(i + 1) % points.size()]}, .parameters = {0.0}});
  return loop;
}

inline LayerOptions layer_options(double height = 4.5e-6) {
  return {.first_height = height};
}

}  // namespace remodel::test
