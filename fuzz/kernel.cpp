// Command sequences on the triangulation: insert, remove, constrain, release, split, begin, commit, rollback,
// with a check after each. A rollback gives back every slot and every free list.

#include <algorithm>
#include <cmath>
#include <vector>

#include "fuzz.h"
#include "remodel/predicates.h"
#include "triangulation/state.h"

using namespace remodel;

namespace {

bool same(const Triangle& a, const Triangle& b) {
  return std::equal(a.vertex, a.vertex + 3, b.vertex) && std::equal(a.link, a.link + 3, b.link) &&
         a.circle.centre == b.circle.centre && a.circle.inside == b.circle.inside &&
         a.circle.outside == b.circle.outside && a.birth == b.birth && a.region == b.region;
}
bool same(const Vertex& a, const Vertex& b) {
  return a.point == b.point && a.star == b.star && a.length_scale == b.length_scale &&
         a.boundary == b.boundary;
}
bool same(const TriangulationState& a, const TriangulationState& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const auto& p, const auto& q) { return same(p, q); });
  };
  return equal(a.vertices, b.vertices) && equal(a.triangles, b.triangles) && a.generations == b.generations &&
         a.free_vertices == b.free_vertices && a.free_triangles == b.free_triangles;
}

class Commands {
 public:
  Commands(fuzz::Bytes bytes) : bytes_(bytes), family_(bytes_.next()) {
    t_.start(at(0, 0), at(15, 1), at(3, 14));
    vertices_ = {VertexId{1}, VertexId{2}, VertexId{3}};
  }

  void run() {
    for (int steps = 0; steps < 200 && !bytes_.empty(); ++steps) {
      step();
      fuzz::require_empty(t_.check());
      fuzz::require(t_.vertex_count() == vertices_.size(), "the vertex count is wrong");
    }
  }

 private:
  // A grid, of whole numbers, of ulps, or of steps that shrink towards a corner.
  Point at(unsigned i, unsigned j) const {
    if (family_ % 3 == 0) return {static_cast<double>(i), static_cast<double>(j)};
    if (family_ % 3 == 1) return {1.0 + i * 0x1p-52, 1.0 + j * 0x1p-52};
    return {std::ldexp(static_cast<double>(i), static_cast<int>(i) - 20),
            std::ldexp(static_cast<double>(j), static_cast<int>(j) - 20)};
  }
  VertexId any() { return vertices_[bytes_.below(static_cast<unsigned>(vertices_.size()))]; }

  void step() {
    switch (bytes_.below(9)) {
      case 0:
      case 1:
      case 2:
        insert();
        break;
      case 3:
        remove();
        break;
      case 4:
        constrain();
        break;
      case 5:
        release();
        break;
      case 6:
        split();
        break;
      case 7:
        begin_or_commit();
        break;
      case 8:
        rollback();
        break;
    }
  }

  void insert() {
    const unsigned place = bytes_.next();
    const auto inserted = t_.insert(at(place & 15U, place >> 4), t_.star(any()).triangle);
    if (inserted.is_new) vertices_.push_back(inserted.vertex);
    fuzz::require(t_.point(inserted.vertex) == at(place & 15U, place >> 4), "the vertex is elsewhere");
  }

  std::vector<Corner> constraints_at(VertexId v) const {
    std::vector<Corner> found;
    const Corner first = t_.star(v);
    Corner c = first;
    do {
      if (t_.link({c.triangle, next3(c.index)}).constrained()) found.push_back({c.triangle, next3(c.index)});
      c = t_.counterclockwise(c);
    } while (c.triangle != first.triangle);
    return found;
  }

  void remove() {
    const VertexId v = any();
    if (!constraints_at(v).empty()) return;
    std::vector<Point> rest;
    for (const VertexId u : vertices_)
      if (u != v) rest.push_back(t_.point(u));
    bool flat = true;
    for (std::size_t i = 2; i < rest.size(); ++i) flat &= orient2d(rest[0], rest[1], rest[i]) == 0;
    if (flat) return;
    t_.remove(v);
    vertices_.erase(std::find(vertices_.begin(), vertices_.end(), v));
  }

  void constrain() {
    const VertexId a = any(), b = any();
    if (a == b) return;
    const ConstrainResult result = t_.constrain(a, b);
    if (result.kind == ConstrainResult::Kind::done) {
      const auto edge = t_.find_edge(a, b);
      fuzz::require(edge && t_.link(*edge).constrained(), "the edge is not constrained");
    } else if (result.kind == ConstrainResult::Kind::vertex) {
      fuzz::require(orient2d(t_.point(a), t_.point(b), t_.point(result.first)) == 0,
                    "the vertex is not on the segment");
    } else {
      const auto edge = t_.find_edge(result.first, result.second);
      fuzz::require(edge && t_.link(*edge).constrained(), "what blocks is no constraint");
    }
  }

  void release() {
    const auto constraints = constraints_at(any());
    if (!constraints.empty())
      t_.release(t_.following(constraints.front()), t_.preceding(constraints.front()));
  }

  void split() {
    const auto constraints = constraints_at(any());
    const unsigned place = bytes_.next();
    if (constraints.empty()) return;
    const auto v = t_.split(constraints.front(), at(place & 15U, place >> 4));
    if (v) vertices_.push_back(*v);
  }

  void begin_or_commit() {
    if (t_.journalling()) {
      t_.commit();
      return;
    }
    before_ = TriangulationState::of(t_);
    vertices_before_ = vertices_;
    t_.begin();
  }

  void rollback() {
    if (!t_.journalling()) return;
    t_.rollback();
    vertices_ = vertices_before_;
    fuzz::require(same(TriangulationState::of(t_), before_), "rollback does not give back the state");
  }

  fuzz::Bytes bytes_;
  unsigned family_;
  Triangulation t_;
  std::vector<VertexId> vertices_, vertices_before_;
  TriangulationState before_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Commands(fuzz::Bytes(data, size)).run();
  return 0;
}
