// The journal: what changed since begin(), so that it can be taken back; and the check of the invariants.

#include <algorithm>
#include <cassert>

#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

// Every change of a record goes through these two. Slots made since begin() have no earlier state.
Triangle& Triangulation::edit(TriangleId t) {
  if (journalling_ && t.index < triangle_slots_before_) triangle_journal_.push_back({t, triangles_[t.index]});
  return triangles_[t.index];
}

Vertex& Triangulation::edit(VertexId v) {
  if (journalling_ && v.index < vertex_slots_before_) vertex_journal_.push_back({v, vertices_[v.index]});
  return vertices_[v.index];
}

void Triangulation::begin() {
  assert(!journalling_);
  for (FreeList* list : {&free_vertices_, &free_triangles_}) list->slots.resize(list->count);
  vertex_slots_before_ = vertices_.size();
  triangle_slots_before_ = triangles_.size();
  live_vertices_before_ = live_vertices_;
  triangle_journal_.clear();
  vertex_journal_.clear();
  generation_journal_.clear();
  inserted_ = removed_ = 0;
  journalling_ = true;
}

void Triangulation::commit() {
  assert(journalling_);
  for (FreeList* list : {&free_vertices_, &free_triangles_}) {
    list->slots.resize(list->count);
    list->slots.insert(list->slots.end(), list->pending.begin(), list->pending.end());
    list->count = list->slots.size();
    list->pending.clear();
  }
  journalling_ = false;
}

void Triangulation::rollback() {
  assert(journalling_);
  journalling_ = false;
  for (auto entry = triangle_journal_.rbegin(); entry != triangle_journal_.rend(); ++entry)
    triangles_[entry->id.index] = entry->triangle;
  for (auto entry = vertex_journal_.rbegin(); entry != vertex_journal_.rend(); ++entry)
    vertices_[entry->id.index] = entry->vertex;
  for (const std::uint32_t index : generation_journal_) --generations_[index];
  vertices_.resize(vertex_slots_before_);
  generations_.resize(vertex_slots_before_);
  triangles_.resize(triangle_slots_before_);
  for (FreeList* list : {&free_vertices_, &free_triangles_}) {
    list->count = list->slots.size();
    list->pending.clear();
  }
  live_vertices_ = live_vertices_before_;
}

std::vector<TriangleId> Triangulation::touched() const {
  std::vector<TriangleId> ids;
  ids.reserve(triangle_journal_.size());
  for (const Earlier& entry : triangle_journal_) ids.push_back(entry.id);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (std::size_t index = triangle_slots_before_; index < triangles_.size(); ++index)
    ids.push_back(TriangleId{static_cast<std::uint32_t>(index)});
  return ids;
}

std::vector<Triangulation::Earlier> Triangulation::earlier() const {
  std::vector<Earlier> first = triangle_journal_;
  std::stable_sort(first.begin(), first.end(), [](const Earlier& a, const Earlier& b) { return a.id < b.id; });
  first.erase(std::unique(first.begin(), first.end(),
                          [](const Earlier& a, const Earlier& b) { return a.id == b.id; }),
              first.end());
  return first;
}

// Invariants (1) and (2) at one triangle.
std::string Triangulation::check_triangle(std::uint32_t index) const {
  const std::string name = "triangle " + std::to_string(index);
  const Triangle& t = triangles_[index];
  for (int i = 0; i < 3; ++i) {
    const Link link = t.link[i];
    const int j = link.corner();
    if (link.triangle().index >= triangles_.size() || j > 2) return name + ": link out of range";
    const Triangle& u = triangles_[link.triangle().index];
    if (!u.alive()) return name + ": link to a free slot";
    if (u.link[j] != Link(TriangleId{index}, i, link.constrained())) return name + ": link does not return";
    if (u.vertex[next3(j)] != t.vertex[previous3(i)] || u.vertex[previous3(j)] != t.vertex[next3(i)])
      return name + ": the neighbour across corner " + std::to_string(i) + " has another edge";
  }
  if (!t.ghost() && orient2d(point(t.vertex[0]), point(t.vertex[1]), point(t.vertex[2])) <= 0)
    return name + ": not counter-clockwise";
  return {};
}

std::string Triangulation::check_topology() const {
  for (std::uint32_t index = 0; index < triangles_.size(); ++index)
    if (triangles_[index].alive())
      if (std::string broken = check_triangle(index); !broken.empty()) return broken;
  for (std::uint32_t index = 0; index < vertices_.size(); ++index) {
    if (!vertices_[index].alive()) continue;
    const Corner c = corner(vertices_[index].star);
    if (c.triangle.index >= triangles_.size() || c.index > 2 || !triangles_[c.triangle.index].alive() ||
        vertex(c) != VertexId{index})
      return "vertex " + std::to_string(index) + ": its star is not at it";
  }
  return {};
}

std::string Triangulation::check() const {
  if (std::string broken = check_topology(); !broken.empty()) return broken;
  for (std::uint32_t index = 0; index < triangles_.size(); ++index) {
    const Triangle& t = triangles_[index];
    if (!t.alive() || t.ghost()) continue;
    for (int i = 0; i < 3; ++i) {
      const VertexId apex = vertex({t.link[i].triangle(), t.link[i].corner()});
      if (!t.link[i].constrained() && in_conflict(t.vertex[0], t.vertex[1], t.vertex[2], apex))
        return "triangle " + std::to_string(index) + ": edge opposite corner " + std::to_string(i) +
               " is not locally Delaunay";
    }
  }
  return {};
}

}  // namespace remodel
