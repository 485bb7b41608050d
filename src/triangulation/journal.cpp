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

std::string Triangulation::check() const {
  const auto name = [](std::uint32_t index) { return "triangle " + std::to_string(index); };
  for (std::uint32_t index = 0; index < triangles_.size(); ++index) {
    const Triangle& t = triangles_[index];
    if (!t.alive()) continue;
    for (int i = 0; i < 3; ++i) {
      const Link link = t.link[i];
      if (link.triangle().index >= triangles_.size() || link.corner() > 2) return name(index) + ": link out of range";
      const Triangle& u = triangles_[link.triangle().index];
      if (!u.alive()) return name(index) + ": link to a free slot";
      if (u.link[link.corner()] != Link(TriangleId{index}, i, link.constrained()))
        return name(index) + ": link does not return";
      if (u.vertex[next3(link.corner())] != t.vertex[previous3(i)] ||
          u.vertex[previous3(link.corner())] != t.vertex[next3(i)])
        return name(index) + ": neighbour across corner " + std::to_string(i) + " has another edge";
      if (!t.ghost() && !u.ghost() && !link.constrained() &&
          incircle_sos(point(t.vertex[0]), point(t.vertex[1]), point(t.vertex[2]), point(u.vertex[link.corner()])) > 0)
        return name(index) + ": edge opposite corner " + std::to_string(i) + " is not locally Delaunay";
    }
    if (!t.ghost() && orient2d(point(t.vertex[0]), point(t.vertex[1]), point(t.vertex[2])) <= 0)
      return name(index) + ": not counter-clockwise";
  }
  for (std::uint32_t index = 0; index < vertices_.size(); ++index) {
    const Vertex& v = vertices_[index];
    if (!v.alive()) continue;
    const Corner c = corner(v.star);
    if (c.triangle.index >= triangles_.size() || !triangles_[c.triangle.index].alive() ||
        vertex(c) != VertexId{index})
      return "vertex " + std::to_string(index) + ": its star is not at it";
  }
  return {};
}

}  // namespace remodel
