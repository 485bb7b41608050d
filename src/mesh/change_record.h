#pragma once

// What a Mark holds: of everything that has changed since, what it was at the mark.

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "remodel/changes.h"
#include "remodel/point.h"
#include "triangulation/triangulation.h"

namespace remodel {

class ChangeRecord {
 public:
  struct VertexThen {
    VertexId id;
    bool alive;
    std::uint32_t generation;  // of a live one
    Point point;
  };
  struct TriangleThen {
    TriangleId id;
    bool domain;  // a live triangle of the domain
    VertexId vertex[3];
  };

  // A record of a mesh that has so many slots.
  ChangeRecord(std::size_t vertex_slots, std::size_t triangle_slots)
      : vertex_slots_(vertex_slots), triangle_slots_(triangle_slots) {}

  // What a vertex or triangle was before the change under way. Only the first note of each counts.
  void note(const VertexThen& vertex);
  // The same of a live vertex, cheaper. Precondition: no vertex is noted but by this function, and this one
  // not at all.
  void note_first(VertexId id, std::uint32_t generation, Point point) {
    VertexThen& then = vertices_.emplace_back();  // written in place: a copy would wait for its parts
    then.id = id;
    then.alive = true;
    then.generation = generation;
    then.point = point;
  }
  void note(const TriangleThen& triangle);
  // A loop whose curves changed, or all of them.
  void note_loops(std::span<const std::size_t> loops);
  void note_all_loops() { all_loops_ = true; }
  // Another mesh takes the place of the one that is marked.
  void note_exchange() { exchanged_ = true; }
  // Room for so many more vertices, of so many slots, and for so many loops: noting them throws nothing then.
  void reserve(std::size_t vertices, std::size_t slots, std::size_t loops);

  std::size_t vertex_slots() const { return vertex_slots_; }  // at the mark
  std::size_t triangle_slots() const { return triangle_slots_; }
  std::span<const VertexThen> vertices() const { return vertices_; }
  std::span<const TriangleThen> triangles() const { return triangles_; }
  bool loop_changed(std::size_t loop) const;
  bool exchanged() const { return exchanged_; }

  // Where a step began, to return there when it is taken back.
  struct Extent {
    std::size_t vertices = 0, triangles = 0, loops = 0;
    bool all_loops = false, exchanged = false;
  };
  Extent extent() const;
  void truncate(const Extent& extent) noexcept;

 private:
  std::size_t vertex_slots_, triangle_slots_;
  std::vector<VertexThen> vertices_;
  std::vector<TriangleThen> triangles_;
  std::vector<std::size_t> loops_;
  bool all_loops_ = false, exchanged_ = false;
  std::vector<bool> noted_vertices_, noted_triangles_;  // by slot
  std::size_t listed_ = 0;                              // so many of vertices_ are in noted_vertices_
};

// The records of the marks of a mesh that still live.
class ChangeRecords {
 public:
  Mark mark(const Triangulation& triangulation);
  // The record of a mark. Throws Error (argument) where the mark is not among these.
  const ChangeRecord& of(const Mark& mark) const;
  // visit(record): of each live mark.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const std::weak_ptr<ChangeRecord>& weak : records_)
      if (const auto record = weak.lock()) visit(*record);
  }

  // Where a step begins, and the return to there when it is taken back: marks made meanwhile are of no mesh.
  using Moment = std::vector<std::pair<std::weak_ptr<ChangeRecord>, ChangeRecord::Extent>>;
  Moment now() const;
  void return_to(const Moment& moment);

 private:
  std::vector<std::weak_ptr<ChangeRecord>> records_;
};

// Notes what the journal of the triangulation holds.
void note_journal(const Triangulation& triangulation, ChangeRecord& record);
// Notes all of a mesh that makes room for another.
void note_all(const Triangulation& before, const Triangulation& after, ChangeRecord& record);

// What became of all that a record notes, in the order of its notes.
struct Fates {
  std::vector<VertexKey> moved, inserted, removed;
  std::vector<std::uint32_t> gone;  // triangles, as numbers in ChangeRecord::triangles()
  std::vector<TriangleId> born;
  std::vector<bool> other;  // by slot of vertices that are noted: it does not hold what it held
};
Fates fates_in(const Triangulation& triangulation, const ChangeRecord& record);
// The same for everybody: what the record says of a mesh as it is now.
Changes changes_in(const Triangulation& triangulation, const ChangeRecord& record);

}  // namespace remodel
