// Insertion of a vertex by cavity (Bowyer 1981, Watson 1981), constraints not crossed.
//
//   f-----e-----d         f-----e-----d
//   |    / \    |         | `.  |  .' |     The cavity: the triangles whose circles hold p. A search from one
//   |   /   \   |         |   `.|.'   |     of them finds the others through unconstrained edges. They are
//   |  /  p  \  |   ->    |    .p.    |     n - 2, if their ring (a, c, d, e, f) has n edges. Each ring edge
//   | /       \ |         |  .'   `.  |     makes a triangle with p: n, in the same slots and two more.
//   |/         \|         |.'       `.|
//   a-----------c         a-----------c
//
// Why the search below needs no marks. Let p be any point, not a vertex. No vertex w of the triangulation has
// all triangles around it in conflict with p: the triangle at w that holds the direction from p beyond w has
// its two other corners c1, c2 with w + t (w - p) = a positive combination of c1 - w and c2 - w. If p were
// strictly inside its circle, p - w and both c - w would lie in the open half plane of the circle's inner
// normal at w; so would w - p: a contradiction. (Ties count as the symbolic perturbation says and are
// excluded in the same way.) So the cavity has no inner vertex, and triangles reached through unconstrained
// edges form a tree. The argument does not ask that p lies in the cavity: a search for a point behind a
// constraint ends too, unless the point lies on a vertex there: then the search counts its triangles.

#include <cassert>

#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

// Depth first, the edges of each triangle in counter-clockwise order: the ring comes out in order. An edge is
// kept as its link and the vertex where it begins, both as seen from the inside. Behind it lie, in order, the
// neighbour's edge that begins at the same vertex and the one that begins at the neighbour's apex.
bool Triangulation::find_cavity(Point p, TriangleId start, Cavity& cavity) const {
  Buffer<TriangleId>::Writer triangles(cavity.triangles);
  Buffer<RingEdge>::Writer ring(cavity.ring), todo(cavity.todo);
  bool constrained = false;
  triangles.push_back(start);
  const Triangle& first = triangles_[start.index];
  for (int i = 2; i >= 0; --i) todo.push_back({first.vertex[next3(i)], first.link[i]});
  while (!todo.empty()) {
    auto [from, link] = todo.pop();
    while (!link.constrained() && in_conflict(link.triangle(), p)) {
      const Triangle& triangle = triangles_[link.triangle().index];
      const int apex = link.corner();
      const Link later = triangle.link[previous3(apex)];
      if (triangles.size() == triangles_.size()) return false;
      triangles.push_back(link.triangle());
      todo.push_back({triangle.vertex[apex], later});
      prefetch(later.triangle());
      link = triangle.link[next3(apex)];
    }
    ring.push_back({from, link});
    constrained |= link.constrained();
    prefetch(from);
  }
  cavity.constrained = constrained;
  return true;
}

// New triangle k is (p, from_k, from_k+1); the cavity's own slots are used first, then two more.
VertexId Triangulation::fill_cavity(Point p, Cavity& cavity) {
  const std::size_t n = cavity.ring.size();
  const Region region = triangles_[cavity.triangles.front().index].region;
  while (cavity.triangles.size() < n) cavity.triangles.push_back(new_triangle());
  assert(cavity.triangles.size() == n);
  const VertexId v = new_vertex(p);
  spokes_.begin(p, n);
  for (std::size_t k = 0; k < n; ++k) spokes_.set(k, point(cavity.ring[k].from));
  spokes_.compute();
  TriangleId before = cavity.triangles[n - 1], t = cavity.triangles[0];
  RingEdge edge = cavity.ring[0];
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t following = k + 1 == n ? 0 : k + 1;
    const TriangleId next = cavity.triangles[following];
    const RingEdge next_edge = cavity.ring[following];
    Triangle& triangle = edit(t);
    triangle.vertex[0] = v;
    triangle.vertex[1] = edge.from;
    triangle.vertex[2] = next_edge.from;
    triangle.link[0] = edge.outer;
    triangle.link[1] = Link(next, 2);
    triangle.link[2] = Link(before, 1);
    triangle.circle = spokes_.circle(k);
    if (edge.from == infinite_vertex || next_edge.from == infinite_vertex) triangle.circle = {};
    triangle.birth = step_;
    triangle.region = region;
    triangle.badness = 0;
    edit(edge.outer.triangle()).link[edge.outer.corner()] = Link(t, 0, edge.outer.constrained());
    set_star(edge.from, t, 1);
    before = t, t = next, edge = next_edge;
  }
  set_star(v, cavity.triangles[0], 0);
  return v;
}

// Whether p lies in the closed triangle, not at a corner and not on a constrained edge; for a ghost, beyond
// its hull edge.
bool Triangulation::holds(TriangleId t, Point p) const {
  const Triangle& triangle = triangles_[t.index];
  if (triangle.ghost()) return in_conflict_exact(triangle, p);
  int zeros = 0;
  for (int i = 0; i < 3; ++i) {
    const int side = orient2d(point(triangle.vertex[next3(i)]), point(triangle.vertex[previous3(i)]), p);
    if (side < 0 || (side == 0 && triangle.link[i].constrained())) return false;
    if (side == 0) ++zeros;
  }
  return zeros < 2;
}

namespace {

// Appends the ring of one side of an edge, from behind the edge around to it, the edge left out.
void append_side(const Cavity& side, Link edge, Cavity& whole) {
  std::size_t gap = 0;
  while (side.ring[gap].outer != edge) ++gap;
  for (std::size_t k = 1; k < side.ring.size(); ++k)
    whole.ring.push_back(side.ring[(gap + k) % side.ring.size()]);
  for (const TriangleId t : side.triangles) whole.triangles.push_back(t);
}

}  // namespace

//        c                      c
//      /   \                  / | \       a=b is constrained. p need not lie on it: boundaries are curved.
//    /   p   \              /.= p =.\     The rings of the cavity on p's side and on the other side make one
//   a=========b     ->     a='  |  '=b    ring, without a=b. p becomes a vertex inside it; a=p and p=b are
//    \       /              \   |   /     constrained. The triangles at c have the region of p's side, those
//      \   /                  \ | /       at d that of the other side.
//        d                      d
//
// The cavity is one on each side of a-b. On the side of p it starts at p's own triangle. On the other side it
// starts at the triangle next to the edge if p is in its circle; if not, that triangle stays, and the only
// new one there is (p, a, b), which now lies on its side of the boundary.
std::optional<VertexId> Triangulation::split(Corner edge, Point p) {
  Corner other{link(edge).triangle(), link(edge).corner()};
  const int side = orient2d(point(following(edge)), point(preceding(edge)), p);
  if (side < 0) std::swap(edge, other);
  if (side == 0 ? dot(point(following(edge)) - p, point(preceding(edge)) - p) >= 0.0
                : !holds(edge.triangle, p))
    return std::nullopt;
  const VertexId a = following(edge), b = preceding(edge);
  const Region far_region = triangles_[other.triangle.index].region;
  cavity_.triangles.clear();
  cavity_.ring.clear();
  if (!find_cavity(p, edge.triangle, near_)) return std::nullopt;
  append_side(near_, link(edge), cavity_);
  const std::size_t near_edges = cavity_.ring.size();
  if (in_conflict(other.triangle, p)) {
    if (!find_cavity(p, other.triangle, far_)) return std::nullopt;
    append_side(far_, link(other), cavity_);
  } else {
    cavity_.ring.push_back({a, Link(other.triangle, other.index, false)});
  }
  const VertexId v = fill_cavity(p, cavity_);
  for (std::size_t k = near_edges; k < cavity_.triangles.size(); ++k)
    set_region(cavity_.triangles[k], far_region);
  set_constraint(*find_edge(v, a), true);
  set_constraint(*find_edge(v, b), true);
  return v;
}

Triangulation::Inserted Triangulation::insert(Point p, TriangleId hint) {
  const Location where = locate(p, hint);
  const Corner corner{where.triangle, where.corner};
  if (where.kind == Location::Kind::on_vertex) return {vertex(corner), false};
  if (where.kind == Location::Kind::on_edge && link(corner).constrained()) return {*split(corner, p), true};
  [[maybe_unused]] const bool found = find_cavity(p, where.triangle, cavity_);
  assert(found);
  return {fill_cavity(p, cavity_), true};
}

}  // namespace remodel
