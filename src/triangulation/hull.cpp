// Restores the convexity of the hull, which vertices that moved in place may have dented, and dents it.
//
//      o---o                 o---o
//     /     \               /     \        Ghosts (inf, x, y) and (inf, y, z) stand on hull edges that turn
//    x       z     ->      x-------z       towards the mesh at y. A flip of the edge between them, from y to
//     \     /               \     /        infinity, fills the dent with (x, y, z).
//      \   /                 \   /
//        y                     y
//
// The flip back takes it off.

#include <algorithm>
#include <utility>

#include "geometry/in_triangle.h"
#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

namespace {

// The vertices of a hull by x and by y: a dent of a long hull, which may have thousands, is compared with the
// few that are near it.
class HullVertices {
 public:
  explicit HullVertices(const Triangulation& t) {
    t.for_each_corner(infinite_vertex, [&](Corner c) {
      const VertexId v = t.following(c);
      by_x_.emplace_back(t.point(v).x, v);
      by_y_.emplace_back(t.point(v).y, v);
    });
    std::sort(by_x_.begin(), by_x_.end());
    std::sort(by_y_.begin(), by_y_.end());
  }

  // Whether one of them satisfies the condition, of all with x and y in the range of three points.
  template <class Condition>
  bool any_near(Point a, Point b, Point c, Condition condition) const {
    const auto by_x = range(by_x_, std::minmax({a.x, b.x, c.x})),
               by_y = range(by_y_, std::minmax({a.y, b.y, c.y}));
    const auto& fewer = by_x.second - by_x.first < by_y.second - by_y.first ? by_x : by_y;
    return std::any_of(fewer.first, fewer.second,
                       [&](const Entry& entry) { return condition(entry.second); });
  }

 private:
  using Entry = std::pair<double, VertexId>;
  using Entries = std::vector<Entry>;
  static std::pair<Entries::const_iterator, Entries::const_iterator> range(const Entries& entries,
                                                                           std::pair<double, double> bounds) {
    const auto begin = std::partition_point(entries.begin(), entries.end(),
                                            [&](const Entry& entry) { return entry.first < bounds.first; });
    return {begin, std::partition_point(begin, entries.end(),
                                        [&](const Entry& entry) { return entry.first <= bounds.second; })};
  }

  Entries by_x_, by_y_;
};

}  // namespace

// A dent that is filled takes a vertex off the hull, and the edge before it is looked at again. A whole turn
// without a fill ends it.
bool Triangulation::restore_hull() {
  std::size_t size = 0, since_filled = 0, dents_left = 0;
  for_each_corner(infinite_vertex, [&](Corner) { ++size; });
  std::optional<HullVertices> vertices;
  std::vector<TriangleId> filled;
  Corner c = star(infinite_vertex);
  while (since_filled < size) {
    const Corner next = counterclockwise(c);
    const VertexId x = following(c), y = preceding(c), z = preceding(next);
    const Point px = point(x), py = point(y), pz = point(z);
    const bool dent = orient2d(px, py, pz) > 0;
    if (dent && !vertices) vertices.emplace(*this);
    const bool blocked = dent && (size == 3 || vertices->any_near(px, py, pz, [&](VertexId v) {
                           return v != x && v != y && v != z && in_triangle(px, py, pz, point(v));
                         }));
    if (!dent || blocked) {
      dents_left += blocked ? 1 : 0;
      ++since_filled;
      c = next;
      continue;
    }
    const Corner before = clockwise(c);
    filled.push_back(c.triangle);
    flip({c.triangle, next3(c.index)});
    c = before;
    --size;
    since_filled = dents_left = 0;
  }
  restore_delaunay(filled);
  return dents_left == 0;
}

// A vertex that is on the hull already stays so once: two parts of the mesh that only the outside joins, as
// two outer loops are, go on being joined by it.
bool Triangulation::open_hull() {
  std::size_t size = 0, since_opened = 0;
  for_each_corner(infinite_vertex, [&](Corner) { ++size; });
  bool opened = false;
  Corner c = star(infinite_vertex);
  while (since_opened < size) {
    const Link edge = link(c);
    const bool leaves =
        !edge.constrained() && triangles_[edge.triangle().index].region == Region::outside &&
        !any_corner(apex(edge), [&](Corner at) { return triangles_[at.triangle.index].ghost(); });
    if (!leaves) {
      ++since_opened;
      c = counterclockwise(c);
      continue;
    }
    flip(c);  // writes the infinite vertex as the first one
    c = {c.triangle, 0};
    opened = true, since_opened = 0, ++size;
  }
  return opened;
}

}  // namespace remodel
