#pragma once

// A constrained Delaunay triangulation of points in the plane that can be changed anywhere: insert and remove
// vertices, constrain and release edges, move vertices. Knows nothing of shapes.
//
// Invariants between public calls (check() names the one that is broken):
//  (1) Links return: the neighbour across an edge links back to the same edge, with the same constraint bit.
//  (2) Every finite triangle is counter-clockwise; ghosts (one per convex hull edge) close the surface to a
//      sphere.
//  (3) Every unconstrained edge is locally Delaunay under incircle_sos: the triangulation is the unique
//      constrained Delaunay triangulation of its vertices and constraints. Callers that move vertices restore
//      it with restore_delaunay() before they insert. They may remove and unsplit before: that needs (1), (2)
//      and (4) only, promises no more, and what it made has to be restored too.
//  (4) Every vertex's star is a triangle that has it.
//
// Changes between begin() and commit() are journalled: rollback() takes them back in time proportional to
// their number, to the last bit.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/slot_map.h"
#include "triangulation/cavity.h"
#include "triangulation/slot_array.h"
#include "triangulation/spokes.h"
#include "triangulation/triangle.h"

namespace remodel {

struct Location {
  enum class Kind { inside, on_edge, on_vertex, outside } kind = Kind::inside;
  TriangleId triangle;  // contains the point (a ghost for outside)
  int corner = 0;       // on_edge: the edge opposite this corner; on_vertex: this corner
};

struct ConstrainResult {
  enum class Kind {
    done,     // the edge is there and constrained
    vertex,   // the open segment passes exactly through `first`: nothing was changed
    blocked,  // the segment crosses the constrained edge first-second: nothing was changed. Where the hull is
              // dented it may leave it: then there is no such edge, or the vertex is the infinite one
  } kind = Kind::done;
  VertexId first, second;
};

class Triangulation {
 public:
  // ---- reading
  std::size_t vertex_slots() const { return vertices_.size(); }  // slot 0 is the infinite vertex
  std::size_t triangle_slots() const { return triangles_.size(); }
  std::size_t vertex_count() const { return live_vertices_; }  // finite
  const Vertex& operator[](VertexId v) const { return vertices_[v.index]; }
  const Triangle& operator[](TriangleId t) const { return triangles_[t.index]; }
  Point point(VertexId v) const { return vertices_[v.index].point; }
  // How often the id was given out, counted on from the generation at which new slots begin.
  std::uint32_t generation(VertexId v) const { return generations_[v.index]; }

  // Starts to load what a search from a triangle will need: the triangle itself, or its neighbours and
  // vertices.
  void prefetch(TriangleId t) const { __builtin_prefetch(&triangles_[t.index]); }
  void prefetch(VertexId v) const { __builtin_prefetch(&vertices_[v.index]); }
  void prefetch_around(TriangleId t) const {
    for (int i = 0; i < 3; ++i) {
      prefetch(triangles_[t.index].link[i].triangle());
      prefetch(triangles_[t.index].vertex[i]);
    }
  }

  // What its neighbours, which were loaded before, lead to.
  void prefetch_second_ring(TriangleId t) const {
    for (const Link link : triangles_[t.index].link) {
      const Triangle& neighbour = triangles_[link.triangle().index];
      prefetch(neighbour.link[next3(link.corner())].triangle());
      prefetch(neighbour.link[previous3(link.corner())].triangle());
      prefetch(neighbour.vertex[link.corner()]);
    }
  }

  // The corners around a vertex: counter-clockwise and clockwise neighbours of a corner at the same vertex.
  Corner star(VertexId v) const { return corner(vertices_[v.index].star); }
  Corner counterclockwise(Corner c) const {
    const Link link = triangles_[c.triangle.index].link[next3(c.index)];
    return {link.triangle(), next3(link.corner())};
  }
  Corner clockwise(Corner c) const {
    const Link link = triangles_[c.triangle.index].link[previous3(c.index)];
    return {link.triangle(), previous3(link.corner())};
  }
  VertexId vertex(Corner c) const { return triangles_[c.triangle.index].vertex[c.index]; }
  // The vertex opposite an edge, in the triangle behind it.
  VertexId apex(Link edge) const { return triangles_[edge.triangle().index].vertex[edge.corner()]; }
  VertexId following(Corner c) const { return triangles_[c.triangle.index].vertex[next3(c.index)]; }
  VertexId preceding(Corner c) const { return triangles_[c.triangle.index].vertex[previous3(c.index)]; }
  Link link(Corner c) const { return triangles_[c.triangle.index].link[c.index]; }
  // Visits the triangles of the domain in the order of their slots: visit(id, triangle).
  template <class Visit>
  void for_each_domain_triangle(Visit visit) const {
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
      if (triangles_[i].in_domain()) visit(TriangleId{i}, triangles_[i]);
  }
  // The finite vertex of the lowest id. Precondition: there is one.
  VertexId first_vertex() const;
  // Visits the corners at a vertex counter-clockwise, those of ghosts too: visit(corner). The visit must not
  // change the star.
  template <class Visit>
  void for_each_corner(VertexId v, Visit visit) const {
    any_corner(v, [&](Corner c) { return visit(c), false; });
  }
  // Whether one of them, as for_each_corner() visits them, is such: is_such(corner).
  template <class Predicate>
  bool any_corner(VertexId v, Predicate is_such) const {
    const Corner first = star(v);
    Corner c = first;
    do {
      if (is_such(c)) return true;
      c = counterclockwise(c);
    } while (c.triangle != first.triangle);
    return false;
  }
  // The corner opposite the directed edge a -> b, in the triangle on its left; none if there is no such edge.
  std::optional<Corner> find_edge(VertexId a, VertexId b) const;

  // Whether a constrained edge ends at the vertex.
  bool at_constraint(VertexId v) const;

  // The triangle that holds p. Walks from hint; a walk that takes too long ends in a search of all triangles.
  Location locate(Point p, TriangleId hint) const;
  // The circle of three vertices: uncertified (`inside` < 0) if the infinite one is among them.
  Circle circle_of(VertexId a, VertexId b, VertexId c) const;
  // Whether p lies inside t's circumcircle (for a ghost: beyond its hull edge). Exact.
  bool in_conflict(TriangleId t, Point p) const {
    const Triangle& triangle = triangles_[t.index];
    const double d = squared_distance(triangle.circle.centre, p);
    if (d < triangle.circle.inside) return true;
    if (d > triangle.circle.outside) return false;
    return in_conflict_exact(triangle, p);
  }

  // ---- changing. Each function invalidates the triangles it names, and no vertex but the removed one.

  // Room for about this many triangles and half as many vertices, so that they need not be moved on the way
  // there.
  void reserve(std::size_t triangles);
  // The first triangle. Precondition: no vertices yet, a, b, c not collinear.
  void start(Point a, Point b, Point c);

  // Collects the cavity of p from a triangle in conflict with it. Read only. False, and the cavity is of no
  // use, where it has no end, as that of a point at a vertex may.
  [[nodiscard]] bool find_cavity(Point p, TriangleId start, Cavity& cavity) const;
  // Replaces the cavity by the star of a new vertex at p. Precondition: every ring edge is seen from p,
  // strictly from its left. Invalidates the cavity's triangles; cavity.triangles lists the new ones instead,
  // in the order of the ring, and spokes() what was computed of them.
  VertexId fill_cavity(Point p, Cavity& cavity);
  const Spokes& spokes() const { return spokes_; }

  // Replaces a constrained edge a-b, given by a corner opposite it, by a-p and p-b, both constrained; the
  // regions on both sides stay on their sides. p need not lie on the edge (boundaries are curved), but it
  // must lie in one of the two triangles next to it, and not on a vertex: otherwise nothing is changed and
  // there is no result.
  std::optional<VertexId> split(Corner edge, Point p);
  // The inverse of split(): removes a vertex at which two constrained edges end, a-v and v-b, and constrains
  // a-b in their place; the regions stay on their sides. False, and nothing is changed, where a-b does not
  // cut v's star into two polygons, where a third constrained edge ends at v, and at the hull. Precondition:
  // two end there at least.
  bool unsplit(VertexId v);
  // Inserts p; a vertex that is already at p is returned instead. A constrained edge that p lies on is split.
  struct Inserted {
    VertexId vertex;
    bool is_new = true;
  };
  Inserted insert(Point p, TriangleId hint);
  // Removes a vertex at which no constrained edge ends, or several different ones. Invalidates their stars.
  void remove(VertexId v);
  void remove(std::span<const VertexId> vertices);
  // Whether all triangles that remove() would put in the place of v's star are fine. False too where one
  // would be Delaunay only because of a constraint behind the star: then remove() would change more than the
  // star; and at the hull.
  struct Ear {
    VertexId vertex[3];
    Circle circle;
  };
  bool plan_removal(VertexId v, const std::function<bool(const Ear&)>& fine);

  ConstrainResult constrain(VertexId a, VertexId b);
  // Lifts the constraint of an edge and restores invariant (3).
  void release(VertexId a, VertexId b);

  // Moves a vertex and refreshes nothing: the caller calls refresh_circle() or set_moved() for its star and
  // then restore_delaunay(), or keeps the Delaunay property by its own checks.
  void move(VertexId v, Point p, double length_scale) {
    Vertex& vertex = edit(v);
    vertex.point = p;
    vertex.length_scale = length_scale;
  }
  void refresh_circle(TriangleId t) { compute_circle(edit(t)); }
  // What has become of a triangle whose vertices moved: the circle is known already. Cheaper under a journal
  // than a change of another kind, and listed by moved_in_place().
  void set_moved(TriangleId t, const Circle& circle, std::uint32_t birth) {
    Triangle& triangle = triangles_[t.index];
    if (journalling_ && triangle.journal < first_number_)
      moved_journal_.push_back({t, triangle.birth, triangle.circle});
    triangle.circle = circle;
    triangle.birth = birth;
  }
  // The same of a triangle whose circle is not known.
  void set_moved(TriangleId t, std::uint32_t birth) {
    const Triangle& triangle = triangles_[t.index];
    set_moved(t, circle_of(triangle.vertex[0], triangle.vertex[1], triangle.vertex[2]), birth);
  }
  // Lawson flips from the edges opposite all corners of the given triangles.
  void restore_delaunay(std::span<const TriangleId> triangles);
  // Fills dents of the hull with triangles, Delaunay among what is around them, as long as its edges do not
  // cross. False where a dent is left.
  bool restore_hull();
  // The opposite: takes off the hull's triangles of the outside, up to constrained edges, so that none of
  // them turns over where these edges move. False, and nothing has changed, where there is none.
  bool open_hull();

  // Attributes kept for the layers above.
  void set_length_scale(VertexId v, double value) { edit(v).length_scale = value; }
  void set_boundary(VertexId v, std::uint32_t value) { edit(v).boundary = value; }
  void set_region(TriangleId t, Region region) { edit(t).region = region; }
  void set_birth(TriangleId t, std::uint32_t birth) { edit(t).birth = birth; }
  void set_badness(TriangleId t, std::uint8_t badness) {
    triangles_[t.index].badness = badness;
  }                                                    // not journalled
  void touch(TriangleId t) { edit(t); }                // counts as changed: see touched()
  void set_step(std::uint32_t step) { step_ = step; }  // the birth of triangles made from now on

  // Raises all generations, those of slots to come too, so that no key of a vertex is one of the other's.
  void begin_generations_after(const Triangulation& other);

  // ---- journal. An exception out of any function of this class leaves the journal able to roll back;
  // begin() and rollback() throw nothing.
  void begin();
  void commit();
  void rollback();
  bool journalling() const { return journalling_; }
  // The triangle slots changed since begin() by more than set_moved(), new ones included, each once, in the
  // order of their first change; and the earlier state of those that were there at begin(). Both lists grow
  // with every change.
  struct Earlier {
    TriangleId id;
    Triangle triangle;
  };
  std::span<const TriangleId> touched() const { return touched_; }
  // Whether it is among them; after commit() too, until the next begin().
  bool is_touched(TriangleId t) const { return triangles_[t.index].journal >= first_number_; }
  // Under a journal: lists the slots touched from now on by themselves, until the next mark() or begin(), so
  // that a part of a step looks at what it changed alone.
  void mark();
  std::span<const TriangleId> touched_since_mark() const { return touched_since_mark_; }
  std::span<const Earlier> earlier() const { return triangle_journal_; }
  // The triangles that were given to set_moved() before anything else of them changed, with what they had.
  // Those that changed afterwards are in both lists; one that is given twice is here twice.
  struct MovedInPlace {
    TriangleId id;
    std::uint32_t birth;
    Circle circle;
  };
  std::span<const MovedInPlace> moved_in_place() const { return moved_journal_; }
  // Visits those of them that did not change afterwards: visit(id).
  template <class Visit>
  void for_each_moved_only(Visit visit) const {
    for (const MovedInPlace& moved : moved_journal_)
      if (!is_touched(moved.id)) visit(moved.id);
  }
  // Whether two states of a triangle have the same vertices, and the same edges constrained.
  static bool same_edges(const Triangle& a, const Triangle& b);
  // Visits the touched slots that hold a triangle: visit(id, whether it is of the region, at the vertices and
  // behind the constraints that the slot had at begin()).
  template <class Visit>
  void for_each_touched(Visit visit) const {
    auto before = triangle_journal_.begin();  // in the order of touched_, without new slots
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      const TriangleId t = touched_[i];
      const bool was_there = before != triangle_journal_.end() && before->id == t;
      const Triangle* earlier = was_there ? &(before++)->triangle : nullptr;
      const Triangle& now = triangles_[t.index];
      if (!now.alive()) continue;
      visit(t, earlier != nullptr && earlier->alive() && earlier->region == now.region &&
                   same_edges(*earlier, now));
    }
  }
  // The states at begin() of the vertices that have changed since, each once. Vertices in slots made since
  // then are not in it.
  struct VertexBefore {
    VertexId id;
    Vertex vertex;
  };
  std::span<const VertexBefore> earlier_vertices() const { return earlier_vertices_; }
  std::size_t vertex_slots_before() const { return vertex_slots_before_; }  // at begin()
  std::uint32_t vertices_inserted() const { return inserted_; }             // since begin()
  std::uint32_t vertices_removed() const { return removed_; }
  std::size_t edges_flipped() const { return flipped_; }

  // Empty, or the broken invariant with the ids concerned: all of them, or (1), (2) and (4) only.
  std::string check() const;
  std::string check_topology() const;

 private:
  friend struct TriangulationState;

  static Corner corner(Link link) { return {link.triangle(), link.corner()}; }
  // Every change of a record goes through these two, or set_moved().
  Triangle& edit(TriangleId t) {
    Triangle& triangle = triangles_[t.index];
    if (triangle.journal != number_) remember(t);
    return triangle;
  }
  Vertex& edit(VertexId v) {
    if (vertex_journals_[v.index] != number_) remember(v);
    return vertices_[v.index];
  }
  void remember(TriangleId t);
  void remember(VertexId v);
  void begin_number();

  std::string check_triangle(std::uint32_t index) const;
  void set_star(VertexId v, TriangleId t, int corner) {
    const Link star(t, corner);
    if (vertices_[v.index].star != star) edit(v).star = star;
  }
  void connect(Corner a, Corner b, bool constrained);
  void attach(Corner inner, Link outer) { connect(inner, corner(outer), outer.constrained()); }
  TriangleId new_triangle();
  void free_triangle(TriangleId t);
  VertexId new_vertex(Point p);
  void free_vertex(VertexId v);
  void write(TriangleId t, VertexId a, VertexId b, VertexId c, Region region) {
    write(t, a, b, c, region, circle_of(a, b, c));
  }
  void write(TriangleId t, VertexId a, VertexId b, VertexId c, Region region, const Circle& circle);
  void compute_circle(Triangle& triangle) const {
    triangle.circle = circle_of(triangle.vertex[0], triangle.vertex[1], triangle.vertex[2]);
  }
  bool in_conflict_exact(const Triangle& triangle, Point p) const;
  bool in_conflict(VertexId a, VertexId b, VertexId c, VertexId d) const;

  void flip(Corner c);
  bool illegal(Corner c) const;
  bool flippable(Corner c) const;
  // Where p lies, seen from a finite triangle: beyond an edge, or on so many edges.
  struct Sight {
    int beyond = -1;  // the first edge, by its opposite corner, that has p strictly on its far side; -1: none
    int zeros = 0;
    int on[3] = {};
    Location in(TriangleId t) const;  // where it is beyond none
  };
  Sight look(const Triangle& triangle, Point p, int without = -1) const;
  bool holds(TriangleId t, Point p) const;
  void legalise();
  void set_constraint(Corner c, bool constrained);
  Location search_all(Point p) const;

  // remove.cpp: a vertex of the boundary polygon of a removed vertex' star, and the edge from it to the next
  // one.
  struct StarEdge {
    VertexId from;
    Link outer;
    Point point;
  };
  // A triangle of three vertices of the polygon, by position: first < apex < last. Behind its edge from last
  // to first lies the edge of piece `parent` opposite corner `side`; the polygon's last edge, if none.
  struct Piece {
    std::uint32_t first, last;
    std::uint32_t parent;
    int side;
    std::uint32_t apex = no_index;
    Circle circle{};
  };
  struct Hole {
    Buffer<StarEdge> polygon;  // its border, counter-clockwise
    Buffer<TriangleId> slots;
    Buffer<Piece> pieces, todo;
    bool ghost = false,
         constrained = false;  // whether the polygon has the infinite vertex, constrained edges
    Buffer<VertexId> patch;    // of several vertices: those that go
    Buffer<StarEdge> border;   // its edges, and where they end, in no order
    Buffer<VertexId> to;
    void clear();
  };
  void collect_star(VertexId v, Hole& hole) const;
  Corner collect_side(Corner first, Hole& side) const;
  void grow_patch(VertexId seed, std::size_t size, Hole& hole);
  bool collect_border(Hole& hole);
  std::size_t find_apex(const Hole& hole, std::size_t i, std::size_t j, Circle& circle) const;
  template <class Accept>
  bool cut(Hole& hole, Accept accept) const;
  bool cut(Hole& hole) const;
  bool delaunay(const Hole& hole, const Piece& piece) const;
  void remove_patch(VertexId seed, std::size_t size);
  void fill(Hole& hole, std::span<const VertexId> removed, bool is_cut);
  void write_pieces(const Hole& hole, Region region);
  bool is_ear(const std::vector<StarEdge>& polygon, std::size_t i) const;
  void write_ears(const Hole& hole, Region region);

  // constrain.cpp: an edge that a segment crosses, its ends right and left of the segment.
  struct Crossing {
    VertexId right, left;
  };
  ConstrainResult find_crossings(VertexId a, VertexId b);
  void flip_crossings(VertexId a, VertexId b);

  SlotArray<Vertex> vertices_;
  SlotArray<std::uint32_t> generations_;
  SlotArray<std::uint16_t> vertex_journals_;  // numbers of vertices: see last_number_
  SlotArray<Triangle> triangles_;
  // Free slots; those before the count are there to be given out (last first). A triangle's slot that is
  // freed under a journal is given out again at once, while it lies in the caches; a vertex's only after
  // commit().
  struct FreeList {
    std::vector<std::uint32_t> slots;
    std::size_t count = 0;
    std::vector<std::uint32_t> pending;

    void put(std::uint32_t slot, bool journalling);
    void begin() { slots.resize(count); }
    void reserve() { slots.reserve(count + pending.size()); }  // for commit(), which throws nothing then
    void commit();
    void rollback();
  };
  FreeList free_vertices_, free_triangles_;
  std::size_t live_vertices_ = 0;
  std::uint32_t step_ = 0;

  bool journalling_ = false;
  // Journals are numbered, and count one more with each mark. A record has the number of its last change
  // under a journal; 0 in new slots.
  std::uint16_t last_number_ = 0;
  std::uint16_t first_number_ = 1;  // of the last journal
  std::uint16_t number_ = 0;        // for changes from now on; 0 without a journal
  std::vector<Earlier> triangle_journal_;
  std::vector<MovedInPlace> moved_journal_;
  std::vector<TriangleId> touched_, touched_since_mark_;
  bool marked_ = false;
  std::vector<VertexBefore> earlier_vertices_;
  std::vector<std::uint32_t> generation_journal_;
  std::size_t vertex_slots_before_ = 0, triangle_slots_before_ = 0, live_vertices_before_ = 0;
  std::uint32_t inserted_ = 0, removed_ = 0;
  std::size_t flipped_ = 0;  // since begin()

  // Scratch of remove() and unsplit().
  static constexpr std::size_t largest_patch = 64;
  Hole hole_, other_hole_;  // the second: of the other side of a vertex that is unsplit
  SlotSet<TriangleId> in_hole_;
  SlotSet<VertexId> to_remove_;           // to be removed, in no patch yet
  std::vector<std::uint32_t> edge_from_;  // border edge that begins at a vertex
  Spokes spokes_;
  Cavity cavity_, near_, far_;  // the last two: of the sides of an edge that is split
  Buffer<Corner> stack_;
  Buffer<Crossing> crossings_, waiting_, made_;  // of constrain(): to be flipped, in the next round, flipped
};

}  // namespace remodel
