// Removal of vertices: their triangles leave a hole, which is triangulated from one edge of its border
// inwards. The Delaunay triangle at an edge joins the vertex whose circle through the edge holds no other;
// the circles of all vertices on its left side are nested there, so one pass over the border finds it. The
// triangle leaves a smaller polygon on either side.
//
//   d-----c-----b         d-----c-----b
//   |`.   |   .'|         |    / \    |     v goes. Its star leaves a hole: the polygon a, b, c, d, e. From
//   |  `. | .'  |         |   /   \   |     the border's edge e-a the search finds c: no other vertex lies in
//   |    `v'    |   ->    |  /     \  |     the circle of (e, a, c). Two polygons are left, (a, b, c) and
//   |  .'   `.  |         | /       \ |     (c, d, e), and treated alike. Of n triangles n - 2 are left.
//   |.'       `.|         |/         \|
//   e-----------a         e-----------a
//
// The search for the third vertex is that of L. P. Chew, "Constrained Delaunay triangulations", 1989.
//
// Vertices that lie together go together: a patch of a hundred has some fifty triangles in the end, where one
// after the other makes five or six for each. Patches are small because the search is quadratic at worst.
//
// Why this is enough. All triangles counter-clockwise, and a simple polygon as their border: then they cover
// its inside once. They are Delaunay where nothing on the border is constrained, because all of it is in the
// one Delaunay triangulation then. Behind a constrained edge a vertex may hide from another edge: the search
// may get stuck, and what it finds is made Delaunay by flips. Where the triangulation around is not Delaunay,
// as after moves, what comes is no more Delaunay than that, and left to the caller.

#include <cassert>

#include "geometry/in_triangle.h"
#include "remodel/predicates.h"
#include "triangulation/triangulation.h"

namespace remodel {

namespace {

// Whether p lies inside the circle of the counter-clockwise triangle abc.
bool lies_inside(const Circle& circle, Point a, Point b, Point c, Point p) {
  const double distance = squared_distance(circle.centre, p);
  if (distance > circle.outside) return false;
  return distance < circle.inside || incircle_sos(a, b, c, p) > 0;
}

}  // namespace

void Triangulation::Hole::clear() {
  polygon.clear();
  slots.clear();
  pieces.clear();
  todo.clear();
  border.clear();
  to.clear();
  ghost = constrained = false;
}

void Triangulation::collect_star(VertexId v, Hole& hole) const {
  hole.clear();
  for_each_corner(v, [&](Corner c) {
    assert(!link({c.triangle, next3(c.index)}).constrained());
    const VertexId from = following(c);
    const Link outer = link(c);
    hole.polygon.push_back({from, outer, point(from)});
    hole.slots.push_back(c.triangle);
    hole.ghost |= from == infinite_vertex;
    hole.constrained |= outer.constrained();
  });
}

// The third vertex of the Delaunay triangle left of the edge from j to i of the polygon, among those between
// i and j, and the triangle's circle; j where all lie on the wrong side.
std::size_t Triangulation::find_apex(const Hole& hole, std::size_t i, std::size_t j, Circle& circle) const {
  const Point a = hole.polygon[i].point, b = hole.polygon[j].point;
  std::size_t best = j;
  const auto look_at = [&](std::size_t c) {
    const Point p = hole.polygon[c].point;
    if (best != j && !lies_inside(circle, a, hole.polygon[best].point, b, p)) return;
    const Circle next = certified_circle(a, p, b);
    if (!next.certain() && orient2d(a, p, b) <= 0) return;
    best = c;
    circle = next;
  };
  look_at(j - 1);  // the ends are likely, and a small circle early leaves little to compute
  for (std::size_t c = i + 1; c + 1 < j; ++c) look_at(c);
  return best;
}

// Cuts the hole into pieces, on paper. False where that gets stuck, or a piece is not accepted.
template <class Accept>
bool Triangulation::cut(Hole& hole, Accept accept) const {
  if (hole.ghost) return false;
  hole.todo.push_back({0, static_cast<std::uint32_t>(hole.polygon.size() - 1), no_index, 0});
  while (!hole.todo.empty()) {
    Piece piece = hole.todo.back();
    hole.todo.pop_back();
    piece.apex = static_cast<std::uint32_t>(find_apex(hole, piece.first, piece.last, piece.circle));
    if (piece.apex == piece.last || !accept(piece)) return false;
    const auto number = static_cast<std::uint32_t>(hole.pieces.size());
    hole.pieces.push_back(piece);
    if (piece.apex + 1 < piece.last) hole.todo.push_back({piece.apex, piece.last, number, 0});
    if (piece.first + 1 < piece.apex) hole.todo.push_back({piece.first, piece.apex, number, 2});
  }
  return true;
}

bool Triangulation::cut(Hole& hole) const {
  return cut(hole, [](const Piece&) { return true; });
}

// Whether no vertex of the polygon lies in the piece's circle.
bool Triangulation::delaunay(const Hole& hole, const Piece& piece) const {
  const Point a = hole.polygon[piece.first].point, b = hole.polygon[piece.apex].point,
              c = hole.polygon[piece.last].point;
  for (std::size_t k = 0; k < hole.polygon.size(); ++k) {
    if (k == piece.first || k == piece.apex || k == piece.last) continue;
    if (lies_inside(piece.circle, a, b, c, hole.polygon[k].point)) return false;
  }
  return true;
}

// Writes the pieces into the first of the slots.
void Triangulation::write_pieces(const Hole& hole, Region region) {
  for (std::size_t k = 0; k < hole.pieces.size(); ++k) {
    const Piece& piece = hole.pieces[k];
    const TriangleId slot = hole.slots[k];
    Triangle& t = edit(slot);
    const auto attach = [&](int corner, Link outer) {
      t.link[corner] = outer;
      edit(outer.triangle()).link[outer.corner()] = Link(slot, corner, outer.constrained());
    };
    t.vertex[0] = hole.polygon[piece.first].from;
    t.vertex[1] = hole.polygon[piece.apex].from;
    t.vertex[2] = hole.polygon[piece.last].from;
    if (piece.apex + 1 == piece.last) attach(0, hole.polygon[piece.apex].outer);
    if (piece.first + 1 == piece.apex) attach(2, hole.polygon[piece.first].outer);
    attach(1, piece.parent == no_index ? hole.polygon[piece.last].outer
                                       : Link(hole.slots[piece.parent], piece.side));
    t.circle = piece.circle;
    t.birth = step_;
    t.region = region;
    t.badness = 0;
  }
  // Most vertices keep the triangle that they know.
  const auto keep_star = [&](std::uint32_t k, TriangleId slot, int corner) {
    const VertexId v = hole.polygon[k].from;
    if (vertex(star(v)) != v) edit(v).star = Link(slot, corner);
  };
  for (std::size_t k = 0; k < hole.pieces.size(); ++k) {
    const Piece& piece = hole.pieces[k];
    keep_star(piece.first, hole.slots[k], 0);
    keep_star(piece.apex, hole.slots[k], 1);
    keep_star(piece.last, hole.slots[k], 2);
  }
}

namespace {

std::size_t before(std::size_t i, std::size_t n) {
  return i == 0 ? n - 1 : i - 1;
}
std::size_t after(std::size_t i, std::size_t n) {
  return i + 1 == n ? 0 : i + 1;
}

}  // namespace

// Whether the triangle at polygon vertex i can be cut off: it is counter-clockwise and no other vertex of the
// polygon lies in its closed area, or, for a ghost, in conflict with it.
bool Triangulation::is_ear(const std::vector<StarEdge>& polygon, std::size_t i) const {
  const std::size_t n = polygon.size();
  const VertexId a = polygon[before(i, n)].from, b = polygon[i].from, c = polygon[after(i, n)].from;
  const bool ghost = a == infinite_vertex || b == infinite_vertex || c == infinite_vertex;
  if (!ghost && orient2d(point(a), point(b), point(c)) <= 0) return false;
  for (const StarEdge& edge : polygon) {
    const VertexId q = edge.from;
    if (q == a || q == b || q == c || q == infinite_vertex) continue;
    if (ghost) {
      if (in_conflict(a, b, c, q)) return false;
    } else if (in_triangle(point(a), point(b), point(c), point(q))) {
      return false;
    }
  }
  return true;
}

// Any triangulation of the polygon, ear by ear: for polygons with the infinite vertex, and where
// cut() gets stuck.
void Triangulation::write_ears(const Hole& hole, Region region) {
  std::vector<StarEdge> polygon(hole.polygon.begin(), hole.polygon.end());
  for (std::size_t used = 0; polygon.size() >= 3; ++used) {
    const std::size_t n = polygon.size();
    std::size_t ear = n == 3 ? 1 : 0;
    while (n > 3 && !is_ear(polygon, ear)) ++ear;
    assert(ear < n);
    const TriangleId slot = hole.slots[used];
    const std::size_t p = before(ear, n), s = after(ear, n);
    write(slot, polygon[p].from, polygon[ear].from, polygon[s].from, region);
    attach({slot, 0}, polygon[ear].outer);
    attach({slot, 2}, polygon[p].outer);
    if (n == 3) {
      attach({slot, 1}, polygon[s].outer);
      return;
    }
    polygon[p].outer = Link(slot, 1);
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

bool Triangulation::plan_removal(VertexId v, const std::function<bool(const Ear&)>& fine) {
  collect_star(v, hole_);
  return cut(hole_, [&](const Piece& piece) {
    if (hole_.constrained && !delaunay(hole_, piece)) return false;
    return fine(
        {{hole_.polygon[piece.first].from, hole_.polygon[piece.apex].from, hole_.polygon[piece.last].from},
         piece.circle});
  });
}

// The rest of a removal, the hole being known and cut or not: its triangles and the vertices in it go.
void Triangulation::fill(Hole& hole, std::span<const VertexId> removed, bool is_cut) {
  const std::size_t triangles = hole.slots.size() - 2 * removed.size();
  const Region region = triangles_[hole.slots.front().index].region;
  for (std::size_t k = triangles; k < hole.slots.size(); ++k) free_triangle(hole.slots[k]);
  for (const VertexId v : removed) free_vertex(v);
  if (is_cut)
    write_pieces(hole, region);
  else
    write_ears(hole, region);
  if (!is_cut || hole.constrained) restore_delaunay({hole.slots.begin(), triangles});
}

void Triangulation::remove(VertexId v) {
  collect_star(v, hole_);
  fill(hole_, {&v, 1}, cut(hole_));
}

// The triangles at the vertex of `first`, from its edge to the following vertex, a constrained one, to the
// next constrained edge. The last edge of the polygon joins the ends of the two. Returns the corner after
// these.
Corner Triangulation::collect_side(Corner first, Hole& side) const {
  side.clear();
  Corner c = first;
  for (bool last = false; !last; c = counterclockwise(c)) {
    for (const VertexId v : {following(c), preceding(c)}) side.ghost |= v == infinite_vertex;
    side.polygon.push_back({following(c), link(c), point(following(c))});
    side.slots.push_back(c.triangle);
    last = link({c.triangle, next3(c.index)}).constrained();
    if (last) side.polygon.push_back({preceding(c), Link{}, point(preceding(c))});
  }
  return c;
}

//        c                      c
//      / | \                  /   \       a=v and v=b are constrained. v's star is two polygons, on the side
//    /.= v =.\              /       \     of c and on that of d, with a-b as their last edge. Each is cut as
//   a='  |  '=b     ->     a=========b    the hole of a removal is, and keeps its region. a=b becomes
//    \   |   /              \       /     constrained.
//      \ | /                  \   /
//        d                      d
bool Triangulation::unsplit(VertexId v) {
  Corner first = star(v);
  while (!link({first.triangle, previous3(first.index)}).constrained()) first = counterclockwise(first);
  Hole &left = hole_, &right = other_hole_;
  const Corner second = collect_side(first, left);
  assert(second.triangle != first.triangle);
  if (collect_side(second, right).triangle != first.triangle) return false;
  for (Hole* side : {&left, &right})
    if (side->slots.size() < 2 || !cut(*side)) return false;
  const Region regions[] = {triangles_[left.slots[0].index].region, triangles_[right.slots[0].index].region};
  for (Hole* side : {&left, &right}) {
    free_triangle(side->slots[side->slots.size() - 1]);
    Hole& other = side == &left ? right : left;
    side->polygon[side->polygon.size() - 1].outer = Link(other.slots[0], 1, true);
  }
  free_vertex(v);
  write_pieces(left, regions[0]);
  write_pieces(right, regions[1]);
  for (const Hole* side : {&left, &right}) restore_delaunay({side->slots.begin(), side->slots.size() - 1});
  return true;
}

// The triangles at the vertices of a patch, which grows from `seed` by neighbours that wait to be removed.
void Triangulation::grow_patch(VertexId seed, std::size_t size, Hole& hole) {
  hole.clear();
  hole.patch.clear();
  in_hole_.clear(triangles_.size());
  const auto take = [&](VertexId v) {
    if (hole.patch.size() == size || !to_remove_.contains(v)) return;
    to_remove_.erase(v);
    hole.patch.push_back(v);
  };
  take(seed);
  for (std::size_t i = 0; i < hole.patch.size(); ++i)
    for_each_corner(hole.patch[i], [&](Corner c) {
      take(following(c));
      if (in_hole_.insert(c.triangle)) hole.slots.push_back(c.triangle);
    });
}

// The border of the hole's triangles as one polygon. False if it is not a simple one, if other vertices than
// the patch are inside, or constrained edges.
bool Triangulation::collect_border(Hole& hole) {
  for (const TriangleId slot : hole.slots) {
    const Triangle& t = triangles_[slot.index];
    for (int i = 0; i < 3; ++i) {
      const bool inner = in_hole_.contains(t.link[i].triangle());
      if (inner && t.link[i].constrained()) return false;
      if (inner) continue;
      const VertexId from = t.vertex[next3(i)];
      hole.border.push_back({from, t.link[i], point(from)});
      hole.to.push_back(t.vertex[previous3(i)]);
    }
  }
  const std::size_t n = hole.border.size();
  if (hole.slots.size() != 2 * hole.patch.size() + n - 2) return false;
  for (std::size_t k = 0; k < n; ++k) edge_from_[hole.border[k].from.index] = static_cast<std::uint32_t>(k);
  std::size_t k = 0;
  do {
    const StarEdge& edge = hole.border[k];
    if (edge.from == infinite_vertex || edge_from_[edge.from.index] != k) return false;
    hole.polygon.push_back(edge);
    hole.constrained |= edge.outer.constrained();
    k = edge_from_[hole.to[k].index];
  } while (k != 0 && hole.polygon.size() <= n);
  return hole.polygon.size() == n;
}

void Triangulation::remove(std::span<const VertexId> vertices) {
  to_remove_.clear(vertices_.size());
  for (const VertexId v : vertices) to_remove_.insert(v);
  edge_from_.resize(vertices_.size());
  for (const VertexId v : vertices)
    for (std::size_t size = largest_patch; to_remove_.contains(v); size /= 8) remove_patch(v, size);
}

// Removes the seed and up to `size` - 1 of the waiting vertices about it; nothing if they leave a hole that
// cannot be cut, which one vertex always can.
void Triangulation::remove_patch(VertexId seed, std::size_t size) {
  if (size <= 1) {
    to_remove_.erase(seed);
    return remove(seed);
  }
  grow_patch(seed, size, hole_);
  if (collect_border(hole_) && cut(hole_))
    fill(hole_, {hole_.patch.begin(), hole_.patch.size()}, true);
  else
    for (const VertexId v : hole_.patch) to_remove_.insert(v);
}

}  // namespace remodel
