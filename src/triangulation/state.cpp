#include "triangulation/state.h"

#include <cmath>

namespace remodel {

TriangulationState TriangulationState::of(const Triangulation& t) {
  const auto as_committed = [](Triangulation::FreeList list) {
    list.commit();
    return list.slots;
  };
  return {{t.vertices_.begin(), t.vertices_.end()},
          {t.generations_.begin(), t.generations_.end()},
          {t.triangles_.begin(), t.triangles_.end()},
          as_committed(t.free_vertices_),
          as_committed(t.free_triangles_)};
}

// What must hold before anything may follow a link or an id.
std::string TriangulationState::check_ranges() const {
  if (vertices.empty() || vertices.size() != generations.size()) return "vertex arrays differ in length";
  std::size_t dead_vertices = 0, dead_triangles = 0;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    if (!vertices[i].alive()) {
      ++dead_vertices;
      continue;
    }
    if (vertices[i].star.triangle().index >= triangles.size() || vertices[i].star.corner() > 2)
      return "vertex " + std::to_string(i) + ": star out of range";
    const Point p = vertices[i].point;
    if (!(std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate))
      return "vertex " + std::to_string(i) + ": coordinate is not finite, or beyond 1e60";
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!triangles[i].alive()) {
      ++dead_triangles;
      continue;
    }
    for (const VertexId v : triangles[i].vertex)
      if (v.index >= vertices.size() || !vertices[v.index].alive())
        return "triangle " + std::to_string(i) + ": vertex out of range";
  }
  const auto lists_dead = [](const std::vector<std::uint32_t>& list, std::size_t dead, const auto& slots) {
    std::vector<bool> seen(slots.size(), false);
    for (const std::uint32_t i : list) {
      if (i >= slots.size() || slots[i].alive() || seen[i]) return false;
      seen[i] = true;
    }
    return list.size() == dead;
  };
  if (!lists_dead(free_vertices, dead_vertices, vertices))
    return "free vertex list does not match the free slots";
  if (!lists_dead(free_triangles, dead_triangles, triangles))
    return "free triangle list does not match the free slots";
  return {};
}

std::string TriangulationState::restore(Triangulation& result) const {
  if (std::string broken = check_ranges(); !broken.empty()) return broken;
  Triangulation t;
  t.vertices_ = SlotArray<Vertex>(vertices);
  t.generations_ = SlotArray<std::uint32_t>(generations);
  t.vertex_journals_ = SlotArray<std::uint16_t>(std::vector<std::uint16_t>(vertices.size(), 0));
  t.triangles_ = SlotArray<Triangle>(triangles);
  t.free_vertices_ = {free_vertices, free_vertices.size(), {}};
  t.free_triangles_ = {free_triangles, free_triangles.size(), {}};
  for (std::size_t i = 1; i < vertices.size(); ++i) t.live_vertices_ += vertices[i].alive() ? 1 : 0;
  for (Triangle& triangle : t.triangles_)
    if (triangle.alive()) t.compute_circle(triangle);
  if (std::string broken = t.check_topology(); !broken.empty()) return broken;
  result = std::move(t);
  return {};
}

}  // namespace remodel
