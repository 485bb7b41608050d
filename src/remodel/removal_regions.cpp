#include "remodel/removal_regions.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "geometry/vector_clones.h"

namespace remodel {

namespace {

double squared(double v) {
  return v * v;
}

double squared_distance_to_edge(Point p, Point a, Point b) {
  const Point e = b - a;
  const double along = dot(p - a, e), length = dot(e, e);
  if (along <= 0.0) return squared_distance(p, a);
  if (along >= length) return squared_distance(p, b);
  const double across = cross(e, p - a);
  return across * across / length;
}

constexpr std::size_t few_regions = 16, most_regions = 64;

// Discs side by side: loops over them compile to vector instructions.
struct DiscRows {
  double x[most_regions], y[most_regions], squared_radius[most_regions];
  std::size_t vectors = 0;  // the last one is filled up with copies of the last disc
};

// Whether the point lies strictly inside a disc.
REMODEL_VECTOR_CLONES
bool holds(const DiscRows& discs, Point p) {
  std::int64_t found = 0;
  for (std::size_t i = 0; i < discs.vectors * vector_lanes; ++i) {
    const Point u{p.x - discs.x[i], p.y - discs.y[i]};
    found |= dot(u, u) < discs.squared_radius[i] ? 1 : 0;
  }
  return found != 0;
}

// Whether an edge from a to b whose ends lie outside all discs passes through one.
REMODEL_VECTOR_CLONES
bool passes(const DiscRows& discs, Point a, Point b) {
  const Point e{b.x - a.x, b.y - a.y};
  const double length = dot(e, e);
  std::int64_t found = 0;
  for (std::size_t i = 0; i < discs.vectors * vector_lanes; ++i) {
    const Point u{discs.x[i] - a.x, discs.y[i] - a.y};
    const double along = dot(u, e), across = cross(e, u);
    const bool beside = (along > 0.0) & (along < length);
    found |= beside & (across * across / length < discs.squared_radius[i]) ? 1 : 0;
  }
  return found != 0;
}

// A few discs that lie together.
class Discs {
 public:
  explicit Discs(std::span<const RemovalRegion> regions) : low_(regions[0].centre), high_(low_) {
    for (const RemovalRegion& region : regions) {
      low_ = {std::min(low_.x, region.centre.x), std::min(low_.y, region.centre.y)};
      high_ = {std::max(high_.x, region.centre.x), std::max(high_.y, region.centre.y)};
      largest_ = std::max(largest_, squared(region.radius));
    }
    rows_.vectors = whole_vectors(regions.size());
    for (std::size_t i = 0; i < rows_.vectors * vector_lanes; ++i) {
      const RemovalRegion& region = regions[std::min(i, regions.size() - 1)];
      rows_.x[i] = region.centre.x;
      rows_.y[i] = region.centre.y;
      rows_.squared_radius[i] = squared(region.radius);
    }
  }

  // Whether the point lies strictly inside one of them.
  bool contain(Point p) const { return !far(p, p) && holds(rows_, p); }
  // Whether the edge, whose ends lie in none of them, passes through one.
  bool meet(Point a, Point b) const {
    const auto [x0, x1] = std::minmax(a.x, b.x);
    const auto [y0, y1] = std::minmax(a.y, b.y);
    return !far({x0, y0}, {x1, y1}) && passes(rows_, a, b);
  }

 private:
  // Whether a box is out of reach of all centres.
  bool far(Point low, Point high) const {
    const double x = std::max({low_.x - high.x, low.x - high_.x, 0.0});
    const double y = std::max({low_.y - high.y, low.y - high_.y, 0.0});
    return x * x + y * y >= largest_;
  }

  DiscRows rows_;
  Point low_, high_;      // box of the centres
  double largest_ = 0.0;  // radius, squared
};

// The corner of a ghost that is the infinite vertex; 3 for a finite triangle.
int infinite_corner(const Triangle& t) {
  int i = 0;
  while (i < 3 && t.vertex[i] != infinite_vertex) ++i;
  return i;
}

// A finite triangle that meets the region's disc, if one does: the hint, if a corner of it is inside; else
// the one that holds the centre. For a centre outside the hull it is the one behind the nearest hull edge.
// Distances fall towards it along the hull edges that face the centre, since those lie in the triangle of the
// centre and any two of their points.
TriangleId start_of(const Triangulation& triangulation, const RemovalRegion& region) {
  if (!triangulation[region.hint].ghost())
    for (const VertexId v : triangulation[region.hint].vertex)
      if (squared_distance(triangulation.point(v), region.centre) < squared(region.radius))
        return region.hint;
  TriangleId t = triangulation.locate(region.centre, region.hint).triangle;
  if (!triangulation[t].ghost()) return t;
  const auto distance = [&](TriangleId ghost) {
    const Triangle& g = triangulation[ghost];
    const int i = infinite_corner(g);
    return squared_distance_to_edge(region.centre, triangulation.point(g.vertex[next3(i)]),
                                    triangulation.point(g.vertex[previous3(i)]));
  };
  for (bool nearer = true; nearer;) {
    nearer = false;
    const Triangle& ghost = triangulation[t];
    const int i = infinite_corner(ghost);
    for (const int side : {next3(i), previous3(i)}) {
      const TriangleId next = ghost.link[side].triangle();
      if (!triangulation.in_conflict(next, region.centre) || distance(next) >= distance(t)) continue;
      t = next;
      nearer = true;
      break;
    }
  }
  const Triangle& ghost = triangulation[t];
  return ghost.link[infinite_corner(ghost)].triangle();
}

// An edge on the way into the triangle behind it, and whether its ends, as seen from there, are inside.
struct Passage {
  Link link;
  bool from_inside, to_inside;
};

// The search through all triangles that meet one of a few discs, first in, first out: what comes is known
// ahead.
class Search {
 public:
  Search(MeshData& mesh, std::span<const RemovalRegion> regions, List<Passage>& todo, List<VertexId>& found)
      : mesh_(mesh), triangulation_(mesh.triangulation), discs_(regions), todo_(todo), found_(found) {
    mesh_.marks.clear(triangulation_.triangle_slots());
    mesh_.vertex_marks.clear(triangulation_.vertex_slots());
    for (const RemovalRegion& region : regions) {
      const TriangleId t = start_of(triangulation_, region);
      if (!mesh_.marks.visit(t.index)) continue;
      bool is_inside[3];
      for (int i = 0; i < 3; ++i) is_inside[i] = inside(triangulation_[t].vertex[i]);
      for (int i = 0; i < 3; ++i) visit(triangulation_[t], i, is_inside[next3(i)], is_inside[previous3(i)]);
    }
    for (std::size_t k = 0; k < todo_.size(); ++k) {
      if (k + look_ahead < todo_.size()) prefetch_behind(todo_[k + look_ahead].link);
      pass_on(Passage(todo_[k]));  // a copy: the list grows
    }
    todo_.clear();
  }

 private:
  static constexpr std::size_t look_ahead = 4;

  // Asked once a vertex; mesh.numbers holds the answer.
  bool inside(VertexId v) {
    if (!mesh_.vertex_marks.visit(v.index)) return mesh_.numbers[v.index] != 0;
    const Vertex& vertex = triangulation_[v];
    const bool result = discs_.contain(vertex.point);
    mesh_.numbers[v.index] = result ? 1 : 0;
    if (result && vertex.boundary == no_index) found_.push_back(v);
    return result;
  }

  // The triangle itself was asked for when the edge was met.
  void prefetch_behind(Link link) const {
    const Triangle& t = triangulation_[link.triangle()];
    const VertexId apex = t.vertex[link.corner()];
    triangulation_.prefetch(apex);
    mesh_.vertex_marks.prefetch(apex.index);
    for (const Link other : t.link) mesh_.marks.prefetch(other.triangle().index);
  }

  // An edge with an end inside meets a disc; only the others need a closer look.
  void visit(const Triangle& t, int i, bool from_inside, bool to_inside) {
    const TriangleId next = t.link[i].triangle();
    if (mesh_.marks.visited(next.index)) return;
    if (!from_inside && !to_inside &&
        !discs_.meet(triangulation_.point(t.vertex[next3(i)]), triangulation_.point(t.vertex[previous3(i)])))
      return;
    mesh_.marks.visit(next.index);
    triangulation_.prefetch(next);
    todo_.push_back({t.link[i], to_inside, from_inside});
  }

  void pass_on(const Passage& passage) {
    const Triangle& t = triangulation_[passage.link.triangle()];
    const int i = passage.link.corner();
    if (t.vertex[i] == infinite_vertex) return;
    const bool apex_inside = inside(t.vertex[i]);
    visit(t, next3(i), passage.to_inside, apex_inside);
    visit(t, previous3(i), apex_inside, passage.from_inside);
  }

  MeshData& mesh_;
  const Triangulation& triangulation_;
  Discs discs_;
  List<Passage>& todo_;  // empty before and after
  List<VertexId>& found_;
};

// Regions come in the order of their loop, and neighbours overlap: a few are searched together, and as many
// more as have their centres inside the first one. Others would only make each test longer.
std::size_t end_of_group(std::span<const RemovalRegion> regions, std::size_t begin) {
  const RemovalRegion& first = regions[begin];
  const auto overlaps = [&](const RemovalRegion& region) {
    return squared_distance(region.centre, first.centre) < squared(first.radius);
  };
  std::size_t end = std::min(begin + few_regions, regions.size());
  while (end < std::min(begin + most_regions, regions.size()) && overlaps(regions[end])) ++end;
  return end;
}

}  // namespace

List<VertexId> vertices_inside(MeshData& mesh, std::span<const RemovalRegion> regions) {
  List<VertexId> found(&mesh.arena);
  List<Passage> todo(&mesh.arena);
  mesh.numbers.resize(std::max(mesh.triangulation.triangle_slots(), mesh.triangulation.vertex_slots()));
  for (std::size_t begin = 0, end = 0; begin < regions.size(); begin = end) {
    end = end_of_group(regions, begin);
    Search(mesh, regions.subspan(begin, end - begin), todo, found);
  }
  mesh.vertex_marks.clear(mesh.triangulation.vertex_slots());
  std::erase_if(found, [&](VertexId v) { return !mesh.vertex_marks.visit(v.index); });
  return found;
}

}  // namespace remodel
