// The journal: what changed since begin(), so that it can be taken back; and the check of the invariants.

#include <algorithm>
#include <cassert>
#include <limits>

#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

// The first change of a triangle since begin(), or since mark(). Outside of journals numbers are not kept up.
void Triangulation::remember(TriangleId t) {
  if (!journalling_) return;
  if (!is_touched(t)) {
    if (t.index < triangle_slots_before_) {
      triangle_journal_.push_back({t, triangles_[t.index]});
      triangle_journal_.back().triangle.badness = 0;  // refinement may have marked it since begin()
      triangle_journal_.back().triangle.journal = 0;  // numbers may be given out anew before it comes back
    }
    touched_.push_back(t);
  }
  if (marked_) touched_since_mark_.push_back(t);
  triangles_[t.index].journal = number_;
}

// The same of a vertex.
void Triangulation::remember(VertexId v) {
  if (!journalling_) return;
  if (v.index < vertex_slots_before_ && vertex_journals_[v.index] < first_number_)
    earlier_vertices_.push_back({v, vertices_[v.index]});
  vertex_journals_[v.index] = number_;
}

// When all numbers have been given out, what the journal under way has touched gets the first of them.
void Triangulation::begin_number() {
  if (last_number_ == std::numeric_limits<std::uint16_t>::max()) {
    const auto renumber = [&](std::uint16_t& number) {
      number = journalling_ && number >= first_number_ ? 1 : 0;
    };
    for (Triangle& t : triangles_) renumber(t.journal);
    for (std::uint16_t& number : vertex_journals_) renumber(number);
    first_number_ = last_number_ = 1;
  }
  number_ = ++last_number_;
}

void Triangulation::mark() {
  assert(journalling_);
  begin_number();
  touched_since_mark_.clear();
  marked_ = true;
}

bool Triangulation::same_edges(const Triangle& a, const Triangle& b) {
  const int shift = b.corner_of(a.vertex[0]);
  for (int i = 0, j = shift; i < 3; ++i, j = next3(j))
    if (a.vertex[i] != b.vertex[j] || a.link[i].constrained() != b.link[j].constrained()) return false;
  return true;
}

void Triangulation::FreeList::commit() {
  slots.resize(count);
  slots.insert(slots.end(), pending.begin(), pending.end());
  count = slots.size();
  pending.clear();
}

void Triangulation::FreeList::rollback() {
  count = slots.size();
  pending.clear();
}

void Triangulation::begin() {
  assert(!journalling_);
  for (FreeList* list : {&free_vertices_, &free_triangles_}) list->begin();
  vertex_slots_before_ = vertices_.size();
  triangle_slots_before_ = triangles_.size();
  live_vertices_before_ = live_vertices_;
  triangle_journal_.clear();
  moved_journal_.clear();
  touched_.clear();
  touched_since_mark_.clear();
  earlier_vertices_.clear();
  generation_journal_.clear();
  inserted_ = removed_ = 0;
  flipped_ = 0;
  begin_number();
  first_number_ = number_;
  marked_ = false;
  journalling_ = true;
}

void Triangulation::commit() {
  assert(journalling_);
  // All that may throw comes first: until then rollback() is still possible.
  for (FreeList* list : {&free_vertices_, &free_triangles_}) list->reserve();
  for (FreeList* list : {&free_vertices_, &free_triangles_}) list->commit();
  journalling_ = false;
  number_ = 0;
}

void Triangulation::rollback() {
  assert(journalling_);
  journalling_ = false;
  number_ = 0;
  for (auto entry = triangle_journal_.rbegin(); entry != triangle_journal_.rend(); ++entry)
    triangles_[entry->id.index] = entry->triangle;
  for (auto entry = moved_journal_.rbegin(); entry != moved_journal_.rend(); ++entry) {
    triangles_[entry->id.index].circle = entry->circle;
    triangles_[entry->id.index].birth = entry->birth;
  }
  for (auto entry = earlier_vertices_.rbegin(); entry != earlier_vertices_.rend(); ++entry)
    vertices_[entry->id.index] = entry->vertex;
  for (const std::uint32_t index : generation_journal_) --generations_[index];
  vertices_.truncate(vertex_slots_before_);
  generations_.truncate(vertex_slots_before_);
  vertex_journals_.truncate(vertex_slots_before_);
  triangles_.truncate(triangle_slots_before_);
  for (FreeList* list : {&free_vertices_, &free_triangles_}) list->rollback();
  live_vertices_ = live_vertices_before_;
  touched_.clear();
  touched_since_mark_.clear();
  triangle_journal_.clear();
  moved_journal_.clear();
  earlier_vertices_.clear();
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
      const VertexId apex = this->apex(t.link[i]);
      if (!t.link[i].constrained() && in_conflict(t.vertex[0], t.vertex[1], t.vertex[2], apex))
        return "triangle " + std::to_string(index) + ": edge opposite corner " + std::to_string(i) +
               " is not locally Delaunay";
    }
  }
  return {};
}

}  // namespace remodel
