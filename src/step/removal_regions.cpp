#include "step/removal_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

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
// More regions than these are searched in one go. Large ones would have each group of them go through the
// same triangles: with the number of regions that grows as its square.
constexpr std::size_t searched_together = 1024;

struct Disc {
  Point centre;
  double squared_radius;
};

// A few discs that lie together.
class Discs {
 public:
  explicit Discs(std::span<const RemovalRegion> regions)
      : count_(regions.size()), low_(regions[0].centre), high_(low_) {
    for (std::size_t i = 0; i < count_; ++i) {
      const RemovalRegion& region = regions[i];
      discs_[i] = {region.centre, squared(region.radius)};
      low_ = {std::min(low_.x, region.centre.x), std::min(low_.y, region.centre.y)};
      high_ = {std::max(high_.x, region.centre.x), std::max(high_.y, region.centre.y)};
      largest_ = std::max(largest_, discs_[i].squared_radius);
    }
  }

  // The box of the discs.
  Point low() const { return low_ - reach(); }
  Point high() const { return high_ + reach(); }
  // Whether the point lies strictly inside one of them.
  bool contain(Point p) const {
    const auto holds = [&](const Disc& disc) {
      return squared_distance(p, disc.centre) < disc.squared_radius;
    };
    return !far(p, p) && std::any_of(discs_.begin(), discs_.begin() + count_, holds);
  }
  // Whether the edge, whose ends lie in none of them, passes through one.
  bool meet(Point a, Point b) const {
    const auto [x0, x1] = std::minmax(a.x, b.x);
    const auto [y0, y1] = std::minmax(a.y, b.y);
    const Point e = b - a;
    const double length = dot(e, e);
    const auto passes = [&](const Disc& disc) {
      const Point u = disc.centre - a;
      const double along = dot(u, e), across = cross(e, u);
      return along > 0.0 && along < length && across * across / length < disc.squared_radius;
    };
    return !far({x0, y0}, {x1, y1}) && std::any_of(discs_.begin(), discs_.begin() + count_, passes);
  }

 private:
  Point reach() const { return {std::sqrt(largest_), std::sqrt(largest_)}; }
  // Whether a box is out of reach of all centres.
  bool far(Point low, Point high) const {
    const double x = std::max({low_.x - high.x, low.x - high_.x, 0.0});
    const double y = std::max({low_.y - high.y, low.y - high_.y, 0.0});
    return x * x + y * y >= largest_;
  }

  std::array<Disc, most_regions> discs_;
  std::size_t count_;
  Point low_, high_;      // box of the centres
  double largest_ = 0.0;  // radius, squared
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

// Any number of discs: groups of them are the leaves of a binary tree of boxes, built over their order. A
// test that finds a disc ends there.
class DiscTree {
 public:
  explicit DiscTree(std::span<const RemovalRegion> regions) {
    for (std::size_t begin = 0, end = 0; begin < regions.size(); begin = end) {
      end = end_of_group(regions, begin);
      groups_.emplace_back(regions.subspan(begin, end - begin));
    }
    nodes_.reserve(2 * groups_.size());
    build(0, groups_.size());
  }

  bool contain(Point p) const {
    return any(0, p, p, [p](const Discs& discs) { return discs.contain(p); });
  }
  bool meet(Point a, Point b) const {
    const Point low{std::min(a.x, b.x), std::min(a.y, b.y)}, high{std::max(a.x, b.x), std::max(a.y, b.y)};
    return any(0, low, high, [a, b](const Discs& discs) { return discs.meet(a, b); });
  }

 private:
  struct Node {
    Point low, high;
    std::size_t left, right;  // children; of a leaf, its group and no_child
  };
  static constexpr std::size_t no_child = static_cast<std::size_t>(-1);

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({groups_[begin].low(), groups_[begin].high(), begin, no_child});
    if (end - begin == 1) return index;
    const std::size_t middle = begin + (end - begin) / 2;
    const std::size_t left = build(begin, middle), right = build(middle, end);
    const Node &a = nodes_[left], &b = nodes_[right];
    nodes_[index] = {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
                     {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)},
                     left,
                     right};
    return index;
  }

  template <class Test>
  bool any(std::size_t index, Point low, Point high, Test test) const {
    const Node& node = nodes_[index];
    if (high.x < node.low.x || node.high.x < low.x || high.y < node.low.y || node.high.y < low.y)
      return false;
    if (node.right == no_child) return test(groups_[node.left]);
    return any(node.left, low, high, test) || any(node.right, low, high, test);
  }

  std::vector<Discs> groups_;
  std::vector<Node> nodes_;
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

// The search through all triangles that meet one of the discs, first in, first out: what comes is known
// ahead.
template <class AllDiscs>
class Search {
 public:
  Search(MeshData& mesh, std::span<const RemovalRegion> regions, List<Passage>& todo, List<VertexId>& found)
      : mesh_(mesh), triangulation_(mesh.triangulation), discs_(regions), todo_(todo), found_(found) {
    mesh_.seen_triangles.clear(triangulation_.triangle_slots());
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    mesh_.inside_regions.clear(triangulation_.vertex_slots());
    for (const RemovalRegion& region : regions) {
      const TriangleId t = start_of(triangulation_, region);
      if (!mesh_.seen_triangles.insert(t)) continue;
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

  // Asked once a vertex.
  bool inside(VertexId v) {
    if (!mesh_.seen_vertices.insert(v)) return mesh_.inside_regions.contains(v);
    const Vertex& vertex = triangulation_[v];
    if (!discs_.contain(vertex.point)) return false;
    mesh_.inside_regions.insert(v);
    if (vertex.boundary == no_index) found_.push_back(v);
    return true;
  }

  // The triangle itself was asked for when the edge was met.
  void prefetch_behind(Link link) const {
    const Triangle& t = triangulation_[link.triangle()];
    const VertexId apex = t.vertex[link.corner()];
    triangulation_.prefetch(apex);
    mesh_.seen_vertices.prefetch(apex);
    for (const Link other : t.link) mesh_.seen_triangles.prefetch(other.triangle());
  }

  // An edge with an end inside meets a disc; only the others need a closer look.
  void visit(const Triangle& t, int i, bool from_inside, bool to_inside) {
    const TriangleId next = t.link[i].triangle();
    if (mesh_.seen_triangles.contains(next)) return;
    if (!from_inside && !to_inside &&
        !discs_.meet(triangulation_.point(t.vertex[next3(i)]), triangulation_.point(t.vertex[previous3(i)])))
      return;
    mesh_.seen_triangles.insert(next);
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
  AllDiscs discs_;
  List<Passage>& todo_;  // empty before and after
  List<VertexId>& found_;
};

}  // namespace

List<VertexId> vertices_inside(MeshData& mesh, std::span<const RemovalRegion> regions) {
  List<VertexId> found(&mesh.arena);
  List<Passage> todo(&mesh.arena);
  if (regions.size() > searched_together) {
    Search<DiscTree>(mesh, regions, todo, found);
    return found;
  }
  for (std::size_t begin = 0, end = 0; begin < regions.size(); begin = end) {
    end = end_of_group(regions, begin);
    Search<Discs>(mesh, regions.subspan(begin, end - begin), todo, found);
  }
  mesh.seen_vertices.clear(mesh.triangulation.vertex_slots());
  std::erase_if(found, [&](VertexId v) { return !mesh.seen_vertices.insert(v); });
  return found;
}

}  // namespace remodel
