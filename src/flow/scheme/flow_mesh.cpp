#include "flow/scheme/flow_mesh.h"

#include <algorithm>
#include <limits>

#include "base/disjoint_sets.h"
#include "flow/scheme/wall_extent.h"
#include "remodel/error.h"

namespace remodel::flow {

namespace {

struct NamedEdge {
  std::uint32_t a, b;
  std::size_t boundary;
  friend bool operator<(const NamedEdge& x, const NamedEdge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }
};

std::vector<NamedEdge> named_edges(const std::vector<FrozenBoundary>& boundaries) {
  std::vector<NamedEdge> named;
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    for (const auto& edge : boundaries[i].edges) {
      named.push_back({edge[0], edge[1], i});
      named.push_back({edge[1], edge[0], i});
    }
  std::sort(named.begin(), named.end());
  return named;
}

std::string list_of_names(const std::vector<FrozenBoundary>& boundaries) {
  std::string names;
  for (const FrozenBoundary& boundary : boundaries) {
    if (boundary.edges.empty()) continue;
    if (!names.empty()) names += ", ";
    names += "'" + boundary.name + "'";
  }
  return names.empty() ? "no boundary" : names;
}

}  // namespace

std::vector<Cell> FlowMesh::cells_of(const FrozenMesh& mesh) {
  std::vector<Cell> cells;
  cells.reserve(mesh.cell_count());
  for (const auto& [a, b, c] : mesh.triangles) cells.push_back({{a, b, c, no_index}});
  for (const auto& corners : mesh.quads) cells.push_back({corners});
  return cells;
}

std::vector<std::array<std::uint32_t, 3>> FlowMesh::triangles() const {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Cell& cell : cells_)
    for (std::uint32_t k = 2; k < cell.corners(); ++k) triangles.push_back({cell[0], cell[k - 1], cell[k]});
  return triangles;
}

FlowMesh::FlowMesh(std::vector<Point> points, std::vector<Cell> cells,
                   const std::vector<FrozenBoundary>& boundaries, std::vector<Patch> patches,
                   const std::string& source)
    : points_(std::move(points)), cells_(std::move(cells)), patches_(std::move(patches)) {
  require_cells(source);
  periodic_ = periodic_vertices(points_, boundaries, patches_, source);
  make_edges(source);
  for (std::size_t v = 0; v < size(); ++v)
    if (ring(v).empty() && !is_image(v))
      throw Error(ErrorCode::argument, source,
                  "point " + std::to_string(v) + " is of no triangle, expected every point to be of one");
  require_sides(source);
  make_boundary(boundaries, source);
  require_free_ends(source);
  link_walls();
  measure();
}

void FlowMesh::stick_to_walls() {
  for (Patch& patch : patches_)
    if (std::holds_alternative<SlipWall>(patch.condition)) patch.condition = NoSlipWall{};
  measure();
}

void FlowMesh::move(std::span<const Point> points, const std::string& source) {
  periodic_.move(points, source);
  points_.assign(points.begin(), points.end());
  measure();
}

// Edges are numbered by their ends, whatever the order of the triangles.
void FlowMesh::make_edges(const std::string& source) {
  struct Side {
    std::uint32_t a, b, cell, corner;
  };
  std::vector<Side> sides;
  sides.reserve(4 * cells_.size());
  for (std::uint32_t t = 0; t < cells_.size(); ++t)
    for (std::uint32_t i = 0, n = cells_[t].corners(); i < n; ++i) {
      const std::uint32_t p = cells_[t][i], q = cells_[t][(i + 1) % n];
      sides.push_back({std::min(original(p), original(q)), std::max(original(p), original(q)), t, i});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    if (x.a != y.a) return x.a < y.a;
    if (x.b != y.b) return x.b < y.b;
    return x.cell < y.cell;
  });
  cell_edges_.assign(cells_.size(), {no_index, no_index, no_index, no_index});
  edges_.clear();
  for (const Side& side : sides) {
    const Cell& cell = cells_[side.cell];
    std::uint32_t p = cell[side.corner], q = cell[(side.corner + 1) % cell.corners()];
    if (original(p) != side.a) std::swap(p, q);
    if (edges_.empty() || edges_.back().a != side.a || edges_.back().b != side.b)
      edges_.push_back({side.a, side.b, {}, {p, q}});
    if (has_images()) require_apart(edges_.back(), p, q, source);
    cell_edges_[side.cell][side.corner] = static_cast<std::uint32_t>(edges_.size() - 1);
  }

  ring_start_.assign(size() + 1, 0);
  for (const DualEdge& edge : edges_) ++ring_start_[edge.a + 1], ++ring_start_[edge.b + 1];
  for (std::size_t v = 0; v < size(); ++v) ring_start_[v + 1] += ring_start_[v];
  ring_.resize(2 * edges_.size());
  std::vector<std::uint32_t> fill(ring_start_.begin(), ring_start_.end() - 1);
  // In the order of edges the smaller neighbours of a vertex come before the larger ones, and both ascend.
  for (std::uint32_t e = 0; e < edges_.size(); ++e) ring_[fill[edges_[e].b]++] = {edges_[e].a, e, {}};
  for (std::uint32_t e = 0; e < edges_.size(); ++e) ring_[fill[edges_[e].a]++] = {edges_[e].b, e, {}};
}

// Whether the edge between these two vertices is the one that its place says: vertices are joined once.
void FlowMesh::require_apart(const DualEdge& edge, std::uint32_t p, std::uint32_t q,
                             const std::string& source) const {
  const Point d = vector(edge), other = points_[q] - points_[p];
  if (edge.a != edge.b && squared_distance(d, other) <= 1e-4 * dot(d, d)) return;
  throw Error(ErrorCode::argument, source,
              "the cells between periodic boundaries are too large at point " + std::to_string(p) +
                  ", which is a neighbour of both, expected three rows of cells or more");
}

// Two cells at most meet at an edge, one on either side: cells do not lie on each other, and periodic
// boundaries have the domain on one side each, and not on the same one.
void FlowMesh::require_sides(const std::string& source) const {
  std::vector<std::array<int, 2>> cells(edges_.size(), {0, 0});
  for (std::size_t t = 0; t < cells_.size(); ++t)
    for (std::uint32_t i = 0; i < cells_[t].corners(); ++i) {
      const std::uint32_t e = cell_edges_[t][i];
      ++cells[e][original(cells_[t][i]) == edges_[e].a ? 0 : 1];
    }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (cells[e][0] > 1 || cells[e][1] > 1) {
      const std::string ends =
          "from point " + std::to_string(edges_[e].place[0]) + " to " + std::to_string(edges_[e].place[1]);
      throw Error(ErrorCode::argument, source,
                  has_images()
                      ? "the periodic boundaries at the edge " + ends +
                            " have cells on the same side, expected the domain to lie between them"
                      : "cells lie on each other at the edge " + ends + ", expected one on each side");
    }
}

// Walls and planes of symmetry end at no periodic boundary: what they are made of goes on beyond it.
void FlowMesh::require_free_ends(const std::string& source) const {
  if (!has_images()) return;
  for (const BoundaryEdge& edge : boundary_) {
    if (patch(edge).is_periodic())
      throw Error(ErrorCode::argument, source,
                  "the edge from point " + std::to_string(edge.place[0]) + " to " +
                      std::to_string(edge.place[1]) + " of the periodic boundary '" + patch(edge).name +
                      "' has no counterpart, expected one at the other boundary");
    if (patch(edge).open()) continue;
    for (const std::uint32_t v : edge.place)
      if (periodic_.at(v))
        throw Error(ErrorCode::argument, source,
                    "the " + std::string(patch(edge).kind()) + " '" + patch(edge).name +
                        "' meets a periodic boundary at point " + std::to_string(v) +
                        ", expected inlets and outlets alone to do so");
  }
}

void FlowMesh::make_boundary(const std::vector<FrozenBoundary>& boundaries, const std::string& source) {
  const std::vector<NamedEdge> named = named_edges(boundaries);
  std::vector<std::uint32_t> uses(edges_.size(), 0);
  for (const auto& of : cell_edges_)
    for (const std::uint32_t e : of)
      if (e != no_index) ++uses[e];
  const std::size_t given = patches_.size();
  std::vector<bool> found_patch(given, false);
  std::vector<std::uint32_t> patch_of(boundaries.size(), no_index);
  const auto patch_of_name = [&](const std::string& name) {
    std::size_t i = 0;
    while (i < given && patches_[i].name != name) ++i;
    if (i < given) {
      found_patch[i] = true;
      has_farfield_ = has_farfield_ || patches_[i].is_farfield();
    } else {
      i = patches_.size();
      patches_.push_back({name, SlipWall{}});
    }
    return static_cast<std::uint32_t>(i);
  };
  for (std::size_t t = 0; t < cells_.size(); ++t)
    for (std::uint32_t i = 0, n = cells_[t].corners(); i < n; ++i) {
      if (uses[cell_edges_[t][i]] != 1) continue;
      const std::uint32_t a = cells_[t][i], b = cells_[t][(i + 1) % n];
      const auto found = std::lower_bound(named.begin(), named.end(), NamedEdge{a, b, 0});
      if (found == named.end() || found->a != a || found->b != b)
        throw Error(ErrorCode::argument, source,
                    "the edge from point " + std::to_string(a) + " to " + std::to_string(b) +
                        " bounds the domain and has no name, expected a named boundary");
      std::uint32_t& patch = patch_of[found->boundary];
      if (patch == no_index) patch = patch_of_name(boundaries[found->boundary].name);
      boundary_.push_back({original(a), original(b), {}, patch, n == 3, {}, {a, b}});
    }
  // Ducts need no far field. Of several parts each has to be there.
  const auto parts = std::count_if(patches_.begin(), patches_.begin() + static_cast<std::ptrdiff_t>(given),
                                   [](const Patch& patch) { return patch.is_farfield(); });
  for (std::size_t i = 0; i < given; ++i)
    if (!found_patch[i] && !patches_[i].is_periodic() &&
        (!patches_[i].is_farfield() || given == 1 || parts > 1)) {
      const std::string kind = patches_[i].kind();
      throw Error(ErrorCode::argument, source,
                  "found boundaries " + list_of_names(boundaries) + ", expected " +
                      (kind.find_first_of("aeiou") == 0 ? "an " : "a ") + kind + " of the name '" +
                      patches_[i].name + "'");
    }
}

void FlowMesh::require_walls(const std::string& source) const {
  if (std::none_of(patches_.begin(), patches_.end(), [](const Patch& patch) { return patch.solid(); }))
    throw Error(ErrorCode::argument, source, "found no wall among the boundaries, expected one");
}

void FlowMesh::require_cells(const std::string& source) const {
  constexpr double least_area = 1e-14;  // as a part of the longest side's square: less is rounding
  for (std::size_t t = 0; t < cells_.size(); ++t) {
    const Cell& cell = cells_[t];
    const std::uint32_t n = cell.corners();
    double area = std::numeric_limits<double>::infinity(), side = 0.0;
    std::string points;
    for (std::uint32_t i = 0; i < n; ++i) {
      area = std::min(area, corner_area(cell, i));
      side = std::max(side, squared_distance(points_[cell[i]], points_[cell[(i + 1) % n]]));
    }
    if (area > least_area * side) continue;
    for (std::uint32_t i = 0; i < n; ++i) points += (i > 0 ? ", " : "") + std::to_string(cell[i]);
    const std::string what = n == 3 ? "triangle" : "quadrilateral";
    throw Error(ErrorCode::argument, source,
                what + " " + std::to_string(t) + " (points " + points + ") " +
                    (area >= -least_area * side ? "has no area"
                     : n == 3                   ? "is clockwise"
                                                : "is clockwise or not convex") +
                    ", expected every " + what + " to be counter-clockwise" + (n == 3 ? "" : " and convex"));
  }
}

// The area of the triangle of a corner and its neighbours.
double FlowMesh::corner_area(const Cell& cell, std::uint32_t corner) const {
  const std::uint32_t n = cell.corners(), i = n == 3 ? 0 : corner;  // a triangle has one area, to the bit
  const Point at = points_[cell[i]];
  return 0.5 * cross(points_[cell[(i + 1) % n]] - at, points_[cell[(i + n - 1) % n]] - at);
}

// Boundaries have the domain on their left: those around it turn counter-clockwise, those of holes clockwise.
void FlowMesh::require_farfield_around(const std::string& source) const {
  DisjointSets loops(size());
  for (const BoundaryEdge& edge : boundary_) loops.join(edge.a, edge.b);
  std::vector<double> area(size(), 0.0);
  for (const BoundaryEdge& edge : boundary_) {
    const std::uint32_t loop = loops.root(edge.a);
    area[loop] += 0.5 * cross(points_[edge.a] - points_[loop], points_[edge.b] - points_[loop]);
  }
  for (const BoundaryEdge& edge : boundary_)
    if (patch(edge).is_farfield() && area[loops.root(edge.a)] < 0.0)
      throw Error(ErrorCode::argument, source,
                  "the far field bounds a hole of the domain, expected it to lie around the walls");
}

void FlowMesh::link_walls() {
  one_sided_.assign(size(), false);
  links_.assign(boundary_.size(), {});
  // The wall's vertex before and after each; none where walls touch.
  std::vector<std::uint32_t> before(size(), no_index), after(size(), no_index);
  std::vector<bool> touching(size(), false);
  for (const BoundaryEdge& edge : boundary_) {
    if (patch(edge).one_sided()) one_sided_[edge.a] = one_sided_[edge.b] = true;
    if (!patch(edge).solid()) continue;
    if (after[edge.a] != no_index) touching[edge.a] = true;
    if (before[edge.b] != no_index) touching[edge.b] = true;
    after[edge.a] = edge.b, before[edge.b] = edge.a;
  }
  for (std::size_t i = 0; i < boundary_.size(); ++i) {
    const BoundaryEdge& edge = boundary_[i];
    if (!patch(edge).solid()) continue;
    WallLink& link = links_[i];
    if (!touching[edge.a]) link.before = before[edge.a];
    if (!touching[edge.b]) link.after = after[edge.b];
    for (const RingEntry& entry : ring(edge.a))
      if (entry.vertex == edge.b) link.edge = entry.edge;
  }
}

// Halves of boundary edges; where they meet beside the edge the dual face follows.
void FlowMesh::bend_walls() {
  for (std::size_t i = 0; i < boundary_.size(); ++i) {
    BoundaryEdge& edge = boundary_[i];
    const Point d = points_[edge.place[1]] - points_[edge.place[0]];
    edge.normal = {d.y, -d.x};
    edge.half[0] = edge.half[1] = 0.5 * edge.normal;
    if (!patch(edge).bent()) continue;
    const Point turn = bulge<double>(i) * d;
    edge.half[0] = edge.half[0] - turn, edge.half[1] = edge.half[1] + turn;
    DualEdge& dual = edges_[links_[i].edge];
    dual.normal = edge.a == dual.a ? dual.normal + turn : dual.normal - turn;
  }
}

// The gradient at a vertex is the mean, weighted by their areas, of those of the triangles that it makes with
// its neighbours in each cell.
void FlowMesh::measure() {
  around_.assign(size(), 0.0);
  areas_.assign(size(), 0.0);
  for (DualEdge& edge : edges_) edge.normal = {};
  for (RingEntry& entry : ring_) entry.weight = {};
  for (std::size_t t = 0; t < cells_.size(); ++t) {
    const Cell& cell = cells_[t];
    const std::uint32_t n = cell.corners();
    Point p[4], centre = {};
    for (std::uint32_t i = 0; i < n; ++i) p[i] = points_[cell[i]], centre = i == 0 ? p[0] : centre + p[i];
    centre = (1.0 / n) * centre;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n, before = (i + n - 1) % n, after = (j + 1) % n;
      const std::uint32_t e = cell_edges_[t][i];
      const Point d = centre - 0.5 * (p[i] + p[j]);
      const std::uint32_t v = original(cell[i]), w = original(cell[j]);
      const double sign = v == edges_[e].a ? 1.0 : -1.0;
      edges_[e].normal = edges_[e].normal + sign * Point{d.y, -d.x};
      around_[v] += corner_area(cell, i);
      areas_[v] += n == 3 ? corner_area(cell, i) / 3.0 : 0.25 * cross(centre - p[i], p[before] - p[j]);
      // The hat function of corner j rises along the inner normal of the opposite side, `before` to i; that
      // of i likewise.
      const Point side_j = p[i] - p[before], side_i = p[after] - p[j];
      RingEntry& at_i = ring_[ring_entry(v, e)];
      at_i.weight = at_i.weight + 0.5 * Point{-side_j.y, side_j.x};
      RingEntry& at_j = ring_[ring_entry(w, e)];
      at_j.weight = at_j.weight + 0.5 * Point{-side_i.y, side_i.x};
    }
  }
  for (std::size_t v = 0; v < size(); ++v)
    for (std::uint32_t i = ring_start_[v]; i < ring_start_[v + 1]; ++i)
      ring_[i].weight = (1.0 / around_[v]) * ring_[i].weight;
  bend_walls();
  std::vector<BoundaryEdge> walls;
  for (const BoundaryEdge& edge : boundary_)
    if (patch(edge).solid()) walls.push_back(edge);
  extent_ = wall_extent(points_, walls);
}

// The edge's place in the ring of one of its ends.
std::uint32_t FlowMesh::ring_entry(std::uint32_t v, std::uint32_t edge) const {
  std::uint32_t i = ring_start_[v];
  while (ring_[i].edge != edge) ++i;
  return i;
}

}  // namespace remodel::flow
