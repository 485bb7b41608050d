// Slots, links, circles, flips and location of the triangulation. Insertion, removal, constraints and the
// journal have files of their own.

#include "triangulation/triangulation.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "remodel/predicates.h"

namespace remodel {

// ---- slots

void Triangulation::FreeList::put(std::uint32_t slot, bool journalling) {
  if (journalling) return pending.push_back(slot);
  slots.resize(count);
  slots.push_back(slot);
  ++count;
}

TriangleId Triangulation::new_triangle() {
  if (std::vector<std::uint32_t>& freed = free_triangles_.pending; !freed.empty()) {
    const TriangleId t{freed.back()};
    freed.pop_back();
    return t;
  }
  if (free_triangles_.count > 0) return TriangleId{free_triangles_.slots[--free_triangles_.count]};
  triangles_.push_back({});
  return TriangleId{static_cast<std::uint32_t>(triangles_.size() - 1)};
}

void Triangulation::free_triangle(TriangleId t) {
  Triangle& triangle = edit(t);
  const std::uint16_t journal = triangle.journal;
  triangle = Triangle{};
  triangle.journal = journal;
  free_triangles_.put(t.index, journalling_);
}

VertexId Triangulation::new_vertex(Point p) {
  VertexId v;
  if (free_vertices_.count > 0) {
    v = VertexId{free_vertices_.slots[--free_vertices_.count]};
  } else {
    v = VertexId{static_cast<std::uint32_t>(vertices_.size())};
    vertices_.push_back({});
    generations_.push_back(generations_[infinite_vertex.index]);
    vertex_journals_.push_back(0);
  }
  Vertex& vertex = edit(v);
  vertex = Vertex{};
  vertex.point = p;
  if (journalling_) generation_journal_.push_back(v.index);
  ++generations_[v.index];
  ++live_vertices_;
  ++inserted_;
  return v;
}

void Triangulation::free_vertex(VertexId v) {
  edit(v) = Vertex{};
  --live_vertices_;
  ++removed_;
  free_vertices_.put(v.index, journalling_);
}

// The infinite vertex has no generation of its own: its entry is where new slots begin.
void Triangulation::begin_generations_after(const Triangulation& other) {
  const std::uint32_t base = 1 + *std::max_element(other.generations_.begin(), other.generations_.end());
  for (std::uint32_t& generation : generations_) generation += base;
}

void Triangulation::reserve(std::size_t triangles) {
  triangles_.reserve(triangles);
  vertices_.reserve(triangles / 2);
  generations_.reserve(triangles / 2);
  vertex_journals_.reserve(triangles / 2);
}

void Triangulation::start(Point a, Point b, Point c) {
  assert(vertices_.empty());
  vertices_.push_back({});  // the infinite vertex
  generations_.push_back(0);
  vertex_journals_.push_back(0);
  if (orient2d(a, b, c) < 0) std::swap(b, c);
  const VertexId va = new_vertex(a), vb = new_vertex(b), vc = new_vertex(c);
  const TriangleId inner = new_triangle();
  const TriangleId ghosts[3] = {new_triangle(), new_triangle(), new_triangle()};
  const VertexId corners[3] = {va, vb, vc};
  write(inner, va, vb, vc, Region::outside);
  for (int i = 0; i < 3; ++i) {
    write(ghosts[i], infinite_vertex, corners[previous3(i)], corners[next3(i)], Region::outside);
    connect({inner, i}, {ghosts[i], 0}, false);
  }
  for (int i = 0; i < 3; ++i) connect({ghosts[i], 1}, {ghosts[previous3(i)], 2}, false);
}

// ---- corners and links

VertexId Triangulation::first_vertex() const {
  std::uint32_t i = 1;
  while (!vertices_[i].alive()) ++i;
  return VertexId{i};
}

bool Triangulation::at_constraint(VertexId v) const {
  return any_corner(v, [&](Corner c) { return link({c.triangle, next3(c.index)}).constrained(); });
}

std::optional<Corner> Triangulation::find_edge(VertexId a, VertexId b) const {
  std::optional<Corner> edge;
  any_corner(a, [&](Corner c) {
    if (following(c) == b) edge = {c.triangle, previous3(c.index)};
    return edge.has_value();
  });
  return edge;
}

void Triangulation::connect(Corner a, Corner b, bool constrained) {
  edit(a.triangle).link[a.index] = Link(b.triangle, b.index, constrained);
  edit(b.triangle).link[b.index] = Link(a.triangle, a.index, constrained);
}

void Triangulation::set_constraint(Corner c, bool constrained) {
  connect(c, corner(link(c)), constrained);
}

void Triangulation::write(TriangleId t, VertexId a, VertexId b, VertexId c, Region region,
                          const Circle& circle) {
  Triangle& triangle = edit(t);
  triangle.vertex[0] = a;
  triangle.vertex[1] = b;
  triangle.vertex[2] = c;
  triangle.region = region;
  triangle.birth = step_;
  triangle.badness = 0;
  triangle.circle = circle;
  set_star(a, t, 0);
  set_star(b, t, 1);
  set_star(c, t, 2);
}

// ---- circles and conflicts

Circle Triangulation::circle_of(VertexId a, VertexId b, VertexId c) const {
  const bool ghost = a == infinite_vertex || b == infinite_vertex || c == infinite_vertex;
  return ghost ? Circle{} : certified_circle(point(a), point(b), point(c));
}

bool Triangulation::in_conflict_exact(const Triangle& t, Point p) const {
  for (int i = 0; i < 3; ++i) {
    if (t.vertex[i] != infinite_vertex) continue;
    const Point a = point(t.vertex[next3(i)]), b = point(t.vertex[previous3(i)]);
    const int side = orient2d(a, b, p);
    return side > 0 || (side == 0 && dot(p - a, p - b) < 0.0);
  }
  return incircle_sos(point(t.vertex[0]), point(t.vertex[1]), point(t.vertex[2]), p) > 0;
}

bool Triangulation::in_conflict(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (d == infinite_vertex) return false;
  Triangle t;
  t.vertex[0] = a;
  t.vertex[1] = b;
  t.vertex[2] = c;
  return in_conflict_exact(t, point(d));
}

// ---- flips
//
//        a                 a
//       / \               /|\.
//      /   \             / | \.
//     b-----c    ->     b  |  c
//      \   /             \ | /
//       \ /               \|/
//        d                 d
//
// (a, b, c) and (d, c, b) become (a, b, d) in the first slot and (a, d, c) in the second.
void Triangulation::flip(Corner corner) {
  const TriangleId first = corner.triangle;
  const int i = corner.index;
  const Triangle t = triangles_[first.index];
  const TriangleId second = t.link[i].triangle();
  const int j = t.link[i].corner();
  const Triangle u = triangles_[second.index];
  const VertexId a = t.vertex[i], b = t.vertex[next3(i)], c = t.vertex[previous3(i)], d = u.vertex[j];
  write(first, a, b, d, t.region);
  write(second, a, d, c, t.region);
  attach({first, 0}, u.link[next3(j)]);
  attach({first, 2}, t.link[previous3(i)]);
  attach({second, 0}, u.link[previous3(j)]);
  attach({second, 1}, t.link[next3(i)]);
  connect({first, 1}, {second, 2}, false);
  ++flipped_;
}

bool Triangulation::flippable(Corner corner) const {
  const Triangle& t = triangles_[corner.triangle.index];
  const VertexId a = t.vertex[corner.index], b = t.vertex[next3(corner.index)],
                 c = t.vertex[previous3(corner.index)], d = apex(t.link[corner.index]);
  return orient2d(point(a), point(b), point(d)) > 0 && orient2d(point(a), point(d), point(c)) > 0;
}

// Whether the edge opposite the corner may be flipped and is not Delaunay.
bool Triangulation::illegal(Corner c) const {
  const Triangle& t = triangles_[c.triangle.index];
  if (!t.alive() || t.ghost() || t.link[c.index].constrained()) return false;
  const Link link = t.link[c.index];
  const Triangle& u = triangles_[link.triangle().index];
  return !u.ghost() && in_conflict(c.triangle, point(u.vertex[link.corner()]));
}

// Lawson's algorithm. Ends because each flip lowers the (symbolically perturbed) lifted surface.
void Triangulation::legalise() {
  while (!stack_.empty()) {
    const Corner c = stack_.back();
    stack_.pop_back();
    if (!illegal(c)) continue;
    const TriangleId first = c.triangle, second = link(c).triangle();
    flip(c);
    for (const Corner next : {Corner{first, 0}, Corner{first, 2}, Corner{second, 0}, Corner{second, 1}})
      stack_.push_back(next);
  }
}

void Triangulation::restore_delaunay(std::span<const TriangleId> triangles) {
  stack_.clear();
  for (const TriangleId t : triangles)
    for (int i = 0; i < 3; ++i)
      if (illegal({t, i})) stack_.push_back({t, i});
  legalise();
}

// ---- location

inline Triangulation::Sight Triangulation::look(const Triangle& triangle, Point p, int without) const {
  Sight sight;
  for (int i = 0; i < 3; ++i) {
    if (i == without) continue;
    const int side = orient2d(point(triangle.vertex[next3(i)]), point(triangle.vertex[previous3(i)]), p);
    if (side < 0) {
      sight.beyond = i;
      break;
    }
    if (side == 0) sight.on[sight.zeros++] = i;
  }
  return sight;
}

Location Triangulation::Sight::in(TriangleId t) const {
  if (zeros == 0) return {Location::Kind::inside, t, 0};
  if (zeros == 1) return {Location::Kind::on_edge, t, on[0]};
  return {Location::Kind::on_vertex, t, 3 - on[0] - on[1]};
}

// The visibility walk: cross any edge that has p strictly on its far side. It cannot cycle in a Delaunay
// triangulation; around constraints it could, so its steps are counted.
Location Triangulation::locate(Point p, TriangleId hint) const {
  TriangleId t = hint;
  if (triangles_[t.index].ghost())
    for (int i = 0; i < 3; ++i)
      if (triangles_[hint.index].vertex[i] == infinite_vertex) t = triangles_[hint.index].link[i].triangle();
  int from = -1;
  for (std::size_t budget = 4 * triangles_.size(); budget > 0; --budget) {
    const Triangle& triangle = triangles_[t.index];
    if (triangle.ghost()) return {Location::Kind::outside, t, 0};
    const Sight sight = look(triangle, p, from);
    if (sight.beyond < 0) return sight.in(t);
    const Link exit = triangle.link[sight.beyond];
    from = exit.corner();
    t = exit.triangle();
  }
  return search_all(p);
}

Location Triangulation::search_all(Point p) const {
  Location outside{Location::Kind::outside, TriangleId{}, 0};
  for (std::uint32_t index = 0; index < triangles_.size(); ++index) {
    const Triangle& t = triangles_[index];
    if (!t.alive()) continue;
    if (t.ghost()) {
      if (in_conflict_exact(t, p)) outside.triangle = TriangleId{index};
      continue;
    }
    if (const Sight sight = look(t, p); sight.beyond < 0) return sight.in(TriangleId{index});
  }
  return outside;
}

}  // namespace remodel
