// The part of a living mesh that has changed since a mark, in time proportional to it.

#include <algorithm>
#include <unordered_set>

#include "mesh/mesh_data.h"
#include "transfer/patches.h"

namespace remodel {

namespace {

using Triple = PatchBuilder::Triple;

Triple triple_of(const VertexId (&vertex)[3]) {
  return {vertex[0].index, vertex[1].index, vertex[2].index};
}

template <class Id>
bool contains(const std::vector<Id>& ascending, Id id) {
  return std::binary_search(ascending.begin(), ascending.end(), id);
}

class SinceMark {
 public:
  SinceMark(const Mesh& mesh, const Mark& mark)
      : triangulation_(mesh.data().triangulation),
        record_(mesh.data().marked.of(mark)),
        changes_(mesh.changes_since(mark)),
        builder_(patches_) {
    for (const ChangeRecord::VertexThen& then : record_.vertices())
      if (then.alive) then_.emplace_back(then.id.index, then.point);
    std::sort(then_.begin(), then_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const VertexKey& key : changes_.inserted) other_.push_back(key.id);
    for (const VertexKey& key : changes_.removed) other_.push_back(key.id);
    std::sort(other_.begin(), other_.end());
  }

  Patches run() {
    count();
    for (const ChangeRecord::TriangleThen& then : record_.triangles())
      if (contains(changes_.gone, then.id)) add_before(triple_of(then.vertex), then.id);
    for (const TriangleId t : changes_.born) add_after(t);
    for (const VertexKey& moved : changes_.moved) add_star(moved.id);
    add_ring();
    builder_.match([&](std::uint32_t number) {
      return std::binary_search(other_.begin(), other_.end(), VertexId{number}) ? no_index : number;
    });
    return std::move(patches_);
  }

 private:
  void count() {
    patches_.vertices_before = record_.vertex_slots(), patches_.triangles_before = record_.triangle_slots();
    patches_.vertices_after = triangulation_.vertex_slots();
    patches_.triangles_after = triangulation_.triangle_slots();
    for (const VertexKey& key : changes_.removed) patches_.gone_vertices.push_back(key.id.index);
    for (const TriangleId t : changes_.gone) patches_.gone_triangles.push_back(t.index);
  }

  Point point_then(std::uint32_t v) const {
    const auto at = std::lower_bound(then_.begin(), then_.end(), v,
                                     [](const auto& entry, std::uint32_t id) { return entry.first < id; });
    return at != then_.end() && at->first == v ? at->second : triangulation_.point(VertexId{v});
  }

  void add_before(const Triple& vertices, TriangleId id) {
    patches_.before.triangles.push_back(
        builder_.before(vertices, id.index, [&](std::uint32_t v) { return point_then(v); }));
  }

  void add_after(TriangleId id) {
    patches_.after.triangles.push_back(
        builder_.after(triple_of(triangulation_[id].vertex), id.index,
                       [&](std::uint32_t v) { return triangulation_.point(VertexId{v}); }));
  }

  bool see(TriangleId t) { return seen_.insert(t.index).second; }  // whether it is new

  // Triangles that have only moved.
  void add_star(VertexId v) {
    triangulation_.for_each_corner(v, [&](Corner c) {
      const Triangle& triangle = triangulation_[c.triangle];
      if (!triangle.in_domain() || contains(changes_.born, c.triangle) || !see(c.triangle)) return;
      add_before(triple_of(triangle.vertex), c.triangle);
      add_after(c.triangle);
    });
  }

  // Triangles around that have not changed: what the vertices of the patch need to know of them.
  void add_ring() {
    for (const TriangleId t : changes_.born) see(t);
    const std::vector<std::uint32_t> rim = patches_.before.numbers;
    for (const std::uint32_t v : rim) {
      if (contains(other_, VertexId{v})) continue;
      triangulation_.for_each_corner(VertexId{v}, [&](Corner c) {
        const Triangle& triangle = triangulation_[c.triangle];
        if (!triangle.in_domain() || !see(c.triangle)) return;
        add_before(triple_of(triangle.vertex), c.triangle);
        add_after(c.triangle);
      });
    }
  }

  const Triangulation& triangulation_;
  const ChangeRecord& record_;
  const Changes changes_;
  Patches patches_;
  PatchBuilder builder_;
  std::vector<std::pair<std::uint32_t, Point>> then_;  // by slot
  std::vector<VertexId> other_;                        // slots that do not hold what they held
  std::unordered_set<std::uint32_t> seen_;             // slots of triangles
};

}  // namespace

Patches patches_since(const Mesh& mesh, const Mark& mark) {
  return SinceMark(mesh, mark).run();
}

}  // namespace remodel
