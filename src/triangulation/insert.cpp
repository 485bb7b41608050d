// Insertion of a vertex by cavity (Bowyer 1981, Watson 1981), constraints not crossed.
//
// Why the search below needs no marks. Let p be any point, not a vertex. No vertex w of the triangulation has all
// triangles around it in conflict with p: the triangle at w that holds the direction from p beyond w has its
// two other corners c1, c2 with w + t (w - p) = a positive combination of c1 - w and c2 - w. If p were strictly
// inside its circle, p - w and both c - w would lie in the open half plane of the circle's inner normal at w;
// so would w - p: a contradiction. (Ties count as the symbolic perturbation says and are excluded in the same
// way.) So the cavity has no inner vertex, and triangles reached through unconstrained edges form a tree. The
// argument does not ask that p lies in the cavity: a search for a point behind a constraint ends too.

#include <cassert>

#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

// Depth first, the edges of each triangle in counter-clockwise order: the ring comes out in order.
void Triangulation::find_cavity(Point p, TriangleId start, Cavity& cavity) const {
  cavity.triangles.clear();
  cavity.ring.clear();
  cavity.triangles.push_back(start);
  Corner todo[64];
  std::vector<Corner> overflow;  // for cavities of unusual depth
  std::size_t depth = 0;
  const auto push = [&](Corner c) {
    if (depth < 64) todo[depth] = c;
    else overflow.push_back(c);
    ++depth;
  };
  const auto pop = [&] {
    --depth;
    if (depth < 64) return todo[depth];
    const Corner c = overflow.back();
    overflow.pop_back();
    return c;
  };
  for (int i = 2; i >= 0; --i) push({start, i});
  while (depth > 0) {
    const Corner c = pop();
    const Triangle& inner = triangles_[c.triangle.index];
    const Link link = inner.link[c.index];
    if (link.constrained() || !in_conflict(link.triangle(), p)) {
      cavity.ring.push_back({inner.vertex[next3(c.index)], link});
      continue;
    }
    cavity.triangles.push_back(link.triangle());
    push({link.triangle(), previous3(link.corner())});
    push({link.triangle(), next3(link.corner())});
  }
}

// New triangle k is (p, from_k, from_k+1); the cavity's own slots are used first, then two more.
VertexId Triangulation::fill_cavity(Point p, const Cavity& cavity) {
  const std::size_t n = cavity.ring.size();
  const Region region = triangles_[cavity.triangles.front().index].region;
  new_star_.assign(cavity.triangles.begin(), cavity.triangles.end());
  while (new_star_.size() < n) new_star_.push_back(new_triangle());
  assert(new_star_.size() == n);
  const VertexId v = new_vertex(p);
  for (std::size_t k = 0; k < n; ++k) {
    const TriangleId t = new_star_[k];
    const RingEdge& edge = cavity.ring[k];
    write(t, v, edge.from, cavity.ring[k + 1 == n ? 0 : k + 1].from, region);
    Triangle& triangle = triangles_[t.index];
    triangle.link[0] = edge.outer;
    triangle.link[1] = Link(new_star_[k + 1 == n ? 0 : k + 1], 2);
    triangle.link[2] = Link(new_star_[k == 0 ? n - 1 : k - 1], 1);
    edit(edge.outer.triangle()).link[edge.outer.corner()] = Link(t, 0, edge.outer.constrained());
  }
  return v;
}

namespace {

// Starts the ring behind the edge whose other side is `across`, and leaves that edge out.
void append_from(const Cavity& side, TriangleId across, Cavity& whole) {
  std::size_t gap = 0;
  while (side.ring[gap].outer.triangle() != across || !side.ring[gap].outer.constrained()) ++gap;
  for (std::size_t k = 1; k < side.ring.size(); ++k)
    whole.ring.push_back(side.ring[(gap + k) % side.ring.size()]);
  whole.triangles.insert(whole.triangles.end(), side.triangles.begin(), side.triangles.end());
}

}  // namespace

Triangulation::Inserted Triangulation::insert(Point p, TriangleId hint) {
  const Location where = locate(p, hint);
  if (where.kind == Location::Kind::on_vertex) return {vertex({where.triangle, where.corner}), false};
  const Link across = triangles_[where.triangle.index].link[where.corner];
  if (where.kind != Location::Kind::on_edge || !across.constrained()) {
    find_cavity(p, where.triangle, cavity_);
    return {fill_cavity(p, cavity_), true};
  }
  // p lies on a constrained edge: the cavity is one on each side, and both halves stay constrained.
  const Region right = triangles_[across.triangle().index].region;
  const VertexId a = vertex({where.triangle, next3(where.corner)});
  const VertexId b = vertex({where.triangle, previous3(where.corner)});
  Cavity left_side, right_side, whole;
  find_cavity(p, where.triangle, left_side);
  find_cavity(p, across.triangle(), right_side);
  append_from(left_side, across.triangle(), whole);
  const std::size_t left_edges = whole.ring.size();
  append_from(right_side, where.triangle, whole);
  const VertexId v = fill_cavity(p, whole);
  for (std::size_t k = left_edges; k < new_star_.size(); ++k) set_region(new_star_[k], right);
  set_constraint(*find_edge(v, a), true);
  set_constraint(*find_edge(v, b), true);
  return {v, true};
}

}  // namespace remodel
