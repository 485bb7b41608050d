// Constraints: an edge is recovered by flipping the edges that it crosses (S. W. Sloan, "A fast algorithm for
// generating constrained Delaunay triangulations", 1993).
//
//      c-----e               c-----e
//     /|    /|\.            /    .' \.     The segment a-b crosses c-d, d-e and e-f. They are flipped in this
//    / |   / | \.          /  .'     \.    order, to a-e, a-f and a-b, which is constrained. An edge whose
//   a  |  /  |  b    ->   a===========b    two triangles form no strictly convex quadrilateral waits for the
//    \ | /   | /           \ `.      /     next round. The other new edges are made Delaunay by flips that
//     \|/    |/             \   `.  /      stop at a=b.
//      d-----f               d-----f

#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

ConstrainResult Triangulation::find_crossings(VertexId a, VertexId b) {
  using Kind = ConstrainResult::Kind;
  crossings_.clear();
  const Point pa = point(a), pb = point(b);
  const auto side = [&](VertexId v) { return v == infinite_vertex ? 0 : orient2d(pa, pb, point(v)); };
  // The triangle at a that the segment leaves through its opposite edge.
  const Corner first = star(a);
  Corner c = first;
  for (;; c = counterclockwise(c)) {
    const VertexId x = following(c), y = preceding(c);
    if (x != infinite_vertex && side(x) == 0 && dot(point(x) - pa, pb - pa) > 0.0)
      return {Kind::vertex, x, {}};
    if (x != infinite_vertex && y != infinite_vertex && side(x) < 0 && side(y) > 0) break;
    if (counterclockwise(c).triangle == first.triangle) return {Kind::blocked, {}, {}};  // a dent of the hull
  }
  Corner edge = c;  // crossed: the edge opposite this corner
  for (;;) {
    const VertexId right = following(edge), left = preceding(edge);
    const Link link = this->link(edge);
    if (link.constrained()) return {Kind::blocked, right, left};
    crossings_.push_back({right, left});
    const VertexId apex = this->apex(link);
    if (apex == b) return {};
    const int s = side(apex);
    if (s == 0) return {Kind::vertex, apex, {}};
    // In the neighbour the edge runs left -> right after its corner `apex`; go on through the edge to the
    // other side.
    edge = {link.triangle(), s > 0 ? next3(link.corner()) : previous3(link.corner())};
  }
}

// Flips until no edge crosses a-b, round by round. An edge whose two triangles do not form a strictly convex
// quadrilateral waits, like one that a flip made and that crosses too.
void Triangulation::flip_crossings(VertexId a, VertexId b) {
  made_.clear();
  while (!crossings_.empty()) {
    waiting_.clear();
    for (const Crossing crossing : crossings_) {
      const Corner c = *find_edge(crossing.right, crossing.left);
      if (!flippable(c)) {
        waiting_.push_back(crossing);
        continue;
      }
      const VertexId p = vertex(c), q = apex(link(c));
      flip(c);
      const auto side = [&](VertexId v) {
        return v == a || v == b ? 0 : orient2d(point(a), point(b), point(v));
      };
      const int sp = side(p), sq = side(q);
      if (sp * sq < 0)
        waiting_.push_back(sp < 0 ? Crossing{p, q} : Crossing{q, p});
      else
        made_.push_back({p, q});
    }
    std::swap(crossings_, waiting_);
  }
  set_constraint(*find_edge(a, b), true);
  stack_.clear();
  for (const auto& [p, q] : made_)
    if (const auto c = find_edge(p, q)) stack_.push_back(*c);
  legalise();
}

ConstrainResult Triangulation::constrain(VertexId a, VertexId b) {
  if (const auto c = find_edge(a, b)) {
    set_constraint(*c, true);
    return {};
  }
  const ConstrainResult result = find_crossings(a, b);
  if (result.kind == ConstrainResult::Kind::done) flip_crossings(a, b);
  return result;
}

void Triangulation::release(VertexId a, VertexId b) {
  const Corner c = *find_edge(a, b);
  set_constraint(c, false);
  stack_.clear();
  stack_.push_back(c);
  legalise();
}

}  // namespace remodel
