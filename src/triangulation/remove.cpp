// Removal of a vertex: its star is retriangulated by clipping ears in Delaunay order (after O. Devillers, "On
// deletion in Delaunay triangulations", 1999; the degree of a vertex is about six, so ears are found by
// looking).

#include <cassert>

#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

namespace {

std::size_t before(std::size_t i, std::size_t n) {
  return i == 0 ? n - 1 : i - 1;
}
std::size_t after(std::size_t i, std::size_t n) {
  return i + 1 == n ? 0 : i + 1;
}

}  // namespace

// Whether the triangle at polygon vertex i can be cut off: it is counter-clockwise and no other vertex of the
// polygon lies in its circle (delaunay) or in its closed area (otherwise). The circle decides nearly always,
// and is kept until a neighbour is cut off.
bool Triangulation::is_ear(std::vector<StarEdge>& polygon, std::size_t i, bool delaunay) const {
  const std::size_t n = polygon.size();
  const VertexId a = polygon[before(i, n)].from, b = polygon[i].from, c = polygon[after(i, n)].from;
  const bool ghost = a == infinite_vertex || b == infinite_vertex || c == infinite_vertex;
  std::optional<Circle>& circle = polygon[i].circle;
  if (!circle) circle = ghost ? Circle{} : certified_circle(point(a), point(b), point(c));
  if (!ghost && !circle->certain() && orient2d(point(a), point(b), point(c)) <= 0) return false;
  for (const StarEdge& edge : polygon) {
    const VertexId q = edge.from;
    if (q == a || q == b || q == c || q == infinite_vertex) continue;
    const double distance = squared_distance(circle->centre, point(q));
    if (distance > circle->outside) continue;
    if (delaunay || ghost) {
      if (distance < circle->inside || in_conflict(a, b, c, q)) return false;
    } else if (orient2d(point(a), point(b), point(q)) >= 0 && orient2d(point(b), point(c), point(q)) >= 0 &&
               orient2d(point(c), point(a), point(q)) >= 0) {
      return false;
    }
  }
  return true;
}

std::size_t Triangulation::find_ear(std::vector<StarEdge>& polygon, bool delaunay) const {
  std::size_t i = 0;
  while (i < polygon.size() && !is_ear(polygon, i, delaunay)) ++i;
  return i;
}

// Writes the ear's triangle (before, i, after) into slot; the polygon's new edge before -> after gets it as
// its outer triangle.
void Triangulation::clip_ear(std::vector<StarEdge>& polygon, std::size_t i, TriangleId slot, Region region) {
  const std::size_t n = polygon.size(), p = before(i, n), s = after(i, n);
  const auto attach = [this](Corner inner, Link outer) {
    connect(inner, {outer.triangle(), outer.corner()}, outer.constrained());
  };
  const VertexId a = polygon[p].from, b = polygon[i].from, c = polygon[s].from;
  write(slot, a, b, c, region, polygon[i].circle ? *polygon[i].circle : circle_of(a, b, c));
  attach({slot, 0}, polygon[i].outer);
  attach({slot, 2}, polygon[p].outer);
  if (n == 3) {
    attach({slot, 1}, polygon[s].outer);
    return;
  }
  polygon[p].outer = Link(slot, 1);
  polygon[p].circle.reset();
  polygon[s].circle.reset();
  polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
}

bool Triangulation::plan_removal(VertexId v, const std::function<bool(const Ear&)>& fine) const {
  std::vector<StarEdge> polygon;
  const Corner first = star(v);
  Corner c = first;
  do {
    polygon.push_back({following(c), link(c), std::nullopt});
    c = counterclockwise(c);
  } while (c.triangle != first.triangle);
  for (;;) {
    const std::size_t n = polygon.size(), ear = n == 3 ? 1 : find_ear(polygon, true);
    if (ear == n) return false;
    if (!fine({polygon[before(ear, n)].from, polygon[ear].from, polygon[after(ear, n)].from})) return false;
    if (n == 3) return true;
    polygon[before(ear, n)].circle.reset();
    polygon[after(ear, n)].circle.reset();
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

void Triangulation::remove(VertexId v) {
  std::vector<StarEdge>& polygon = polygon_;
  std::vector<TriangleId>& slots = slots_;
  polygon.clear();
  slots.clear();
  const Corner first = star(v);
  const Region region = triangles_[first.triangle.index].region;
  Corner c = first;
  do {
    assert(!link({c.triangle, next3(c.index)}).constrained());
    polygon.push_back({following(c), link(c), std::nullopt});
    slots.push_back(c.triangle);
    c = counterclockwise(c);
  } while (c.triangle != first.triangle);

  std::vector<TriangleId> uncertain;  // of ears that only a constraint behind the polygon makes Delaunay
  std::size_t used = 0;
  while (polygon.size() >= 3) {
    const bool last = polygon.size() == 3;
    std::size_t ear = last ? 1 : find_ear(polygon, true);
    if (ear == polygon.size()) {
      ear = find_ear(polygon, false);
      assert(ear < polygon.size());
      uncertain.push_back(slots[used]);
    }
    clip_ear(polygon, ear, slots[used], region);
    ++used;
    if (last) break;
  }
  for (; used < slots.size(); ++used) free_triangle(slots[used]);
  free_vertex(v);
  if (!uncertain.empty()) restore_delaunay(uncertain);
}

}  // namespace remodel
