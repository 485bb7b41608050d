#pragma once

// Applies random commands to a triangulation and keeps plain lists of its expected content, for comparing
// tests.

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "reference/reference.h"
#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel::test {

enum class Family { random, gridded, cocircular, nearly_collinear, nearly_coincident, clustered };
inline constexpr std::array families{Family::random,           Family::gridded,           Family::cocircular,
                                     Family::nearly_collinear, Family::nearly_coincident, Family::clustered};
inline const char* name_of(Family family) {
  static constexpr std::array names{"random",           "gridded",           "cocircular",
                                    "nearly_collinear", "nearly_coincident", "clustered"};
  return names[static_cast<std::size_t>(family)];
}

inline double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

inline Point random_point(std::mt19937_64& random, Family family) {
  const auto whole = [&](unsigned n) { return static_cast<double>(random() % n); };
  switch (family) {
    case Family::random:
      return {unit(random), unit(random)};
    case Family::gridded:
      return {whole(9), whole(9)};
    case Family::cocircular: {  // whole points of the circle of radius 65 about 0, sometimes about another
                                // centre
      static constexpr std::array<std::array<int, 2>, 5> pairs{
          {{16, 63}, {33, 56}, {39, 52}, {25, 60}, {65, 0}}};
      const auto& pair = pairs[random() % pairs.size()];
      const double sx = random() % 2 ? 1 : -1, sy = random() % 2 ? 1 : -1,
                   shift = random() % 3 == 0 ? 130.0 : 0.0;
      const Point p = random() % 2 ? Point{sx * pair[0], sy * pair[1]} : Point{sx * pair[1], sy * pair[0]};
      return {p.x + shift, p.y};
    }
    case Family::nearly_collinear:
      return {whole(2000), whole(3) * 0x1p-40};
    case Family::nearly_coincident:
      return {1.0 + whole(9) * 0x1p-52, 1.0 + whole(9) * 0x1p-52};
    case Family::clustered: {  // sizes from 1 down to 2^-40 about a common corner
      const double scale = std::ldexp(1.0, -static_cast<int>(random() % 40));
      return {scale * unit(random), scale * unit(random)};
    }
  }
  return {};
}

// Commands: insert, remove, constrain, release. The `on_*` callbacks repeat them on a second implementation.
class KernelWalk {
 public:
  KernelWalk(std::mt19937_64& random, Family family) : random_(random), family_(family) {
    for (;;) {
      const Point a = random_point(random, family), b = random_point(random, family),
                  c = random_point(random, family);
      if (orient2d(a, b, c) == 0) continue;
      triangulation.start(a, b, c);
      for (std::uint32_t i = 1; i < 4; ++i) vertices.push_back(VertexId{i});
      return;
    }
  }
  virtual ~KernelWalk() = default;

  void step(std::size_t most_vertices) {
    const std::uint64_t choice = random_() % 16;
    if (vertices.size() >= most_vertices || choice < 4)
      remove_one();
    else if (choice < 7)
      constrain_one();
    else if (choice == 7)
      release_one();
    else
      insert_one();
  }

  std::vector<Point> points() const {
    std::vector<Point> result;
    for (const VertexId v : vertices) result.push_back(triangulation.point(v));
    return result;
  }
  // Faces and constraints by position in `vertices`.
  std::set<reference::Face> faces() const {
    const auto index = indices();
    std::set<reference::Face> result;
    for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
      const Triangle& t = triangulation[TriangleId{i}];
      if (t.alive() && !t.ghost())
        result.insert(
            reference::face_of(index.at(t.vertex[0]), index.at(t.vertex[1]), index.at(t.vertex[2])));
    }
    return result;
  }
  std::set<reference::Edge> constraints() const {
    const auto index = indices();
    std::set<reference::Edge> result;
    for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
      const Triangle& t = triangulation[TriangleId{i}];
      if (!t.alive()) continue;
      for (int k = 0; k < 3; ++k)
        if (t.link[k].constrained())
          result.insert(reference::edge_of(index.at(t.vertex[next3(k)]), index.at(t.vertex[previous3(k)])));
    }
    return result;
  }

  Triangulation triangulation;
  std::vector<VertexId> vertices;

 protected:
  virtual void on_insert(VertexId, Point) {}
  virtual void on_remove(VertexId) {}
  virtual void on_constrain(VertexId, VertexId) {}
  virtual void on_release(VertexId, VertexId) {}

  TriangleId any_triangle() const {
    return triangulation.star(vertices[random_() % vertices.size()]).triangle;
  }

 private:
  std::map<VertexId, std::size_t> indices() const {
    std::map<VertexId, std::size_t> index;
    for (std::size_t i = 0; i < vertices.size(); ++i) index[vertices[i]] = i;
    return index;
  }

  void insert_one() {
    const Point p = random_point(random_, family_);
    const auto inserted = triangulation.insert(p, any_triangle());
    if (!inserted.is_new) return;
    vertices.push_back(inserted.vertex);
    on_insert(inserted.vertex, p);
  }

  bool at_a_constraint(VertexId v) const {
    const Corner first = triangulation.star(v);
    Corner c = first;
    do {
      if (triangulation.link({c.triangle, next3(c.index)}).constrained()) return true;
      c = triangulation.counterclockwise(c);
    } while (c.triangle != first.triangle);
    return false;
  }

  // A triangulation needs three vertices that are not collinear.
  bool needed(VertexId v) const {
    std::vector<Point> rest;
    for (const VertexId u : vertices)
      if (u != v) rest.push_back(triangulation.point(u));
    for (std::size_t i = 2; i < rest.size(); ++i)
      if (orient2d(rest[0], rest[1], rest[i]) != 0) return false;
    return true;
  }

  void remove_one() {
    const std::size_t k = random_() % vertices.size();
    const VertexId v = vertices[k];
    if (needed(v) || at_a_constraint(v)) {
      release_one();
      return;
    }
    on_remove(v);
    triangulation.remove(v);
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(k));
  }

  void constrain_one() {
    const VertexId a = vertices[random_() % vertices.size()], b = vertices[random_() % vertices.size()];
    if (a == b || triangulation.constrain(a, b).kind != ConstrainResult::Kind::done) return;
    on_constrain(a, b);
  }

  void release_one() {
    const auto present = constraints();
    if (present.empty()) return;
    auto chosen = present.begin();
    std::advance(chosen, static_cast<std::ptrdiff_t>(random_() % present.size()));
    const VertexId a = vertices[(*chosen)[0]], b = vertices[(*chosen)[1]];
    on_release(a, b);
    triangulation.release(a, b);
  }

  std::mt19937_64& random_;
  Family family_;
};

}  // namespace remodel::test
