// The part of a living mesh that has changed since a mark, in time proportional to it.

#include "transfer/moment.h"
#include "transfer/patches.h"

namespace remodel {

namespace {

class SinceMark {
 public:
  explicit SinceMark(const Moment& moment)
      : moment_(moment),
        builder_(patches_, 8 * moment.fates.moved.size() + 2 * moment.fates.born.size()),
        seen_(16 * moment.fates.moved.size() + 4 * moment.fates.born.size()) {}

  Patches run() {
    count();
    moment_.for_each_gone([&](TriangleId id, const Moment::Triple& vertices) { add_before(vertices, id); });
    for (const TriangleId t : moment_.fates.born) see(t), add_after(t);
    for (const VertexKey& moved : moment_.fates.moved) add_star(moved.id);
    // Triangles around that have not changed: what the vertices of the patch need to know of their cells, and
    // its triangles for their slopes.
    const std::vector<std::uint32_t> rim = patches_.after.numbers;
    for (const std::uint32_t v : rim)
      if (moment_.is_same(v)) add_star(VertexId{v});
    builder_.match([&](std::uint32_t number) { return moment_.is_same(number) ? number : no_index; });
    return std::move(patches_);
  }

 private:
  void count() {
    patches_.vertices_before = moment_.record.vertex_slots();
    patches_.triangles_before = moment_.record.triangle_slots();
    patches_.vertices_after = moment_.triangulation.vertex_slots();
    patches_.triangles_after = moment_.triangulation.triangle_slots();
    for (const VertexKey& key : moment_.fates.removed) patches_.gone_vertices.push_back(key.id.index);
    moment_.for_each_gone(
        [&](TriangleId id, const Moment::Triple&) { patches_.gone_triangles.push_back(id.index); });
  }

  void add_before(const Moment::Triple& vertices, TriangleId id) {
    patches_.before.triangles.push_back(
        builder_.before(vertices, id.index, [&](std::uint32_t v) { return moment_.point_then(v); }));
  }
  void add_after(TriangleId id) {
    patches_.after.triangles.push_back(
        builder_.after(Moment::triple_of(moment_.triangulation[id]), id.index,
                       [&](std::uint32_t v) { return moment_.triangulation.point(VertexId{v}); }));
  }

  bool see(TriangleId t) { return seen_.emplace(t.index, 0).second; }  // whether it is new

  // Triangles that are there still, at other places or the same.
  void add_star(VertexId v) {
    moment_.triangulation.for_each_corner(v, [&](Corner c) {
      const Triangle& triangle = moment_.triangulation[c.triangle];
      if (!triangle.in_domain() || !see(c.triangle)) return;
      add_before(Moment::triple_of(triangle), c.triangle);
      add_after(c.triangle);
    });
  }

  const Moment& moment_;
  Patches patches_;
  PatchBuilder builder_;
  NumberMap seen_;  // slots of triangles
};

}  // namespace

Patches patches_since(const Moment& moment) {
  return SinceMark(moment).run();
}

}  // namespace remodel
