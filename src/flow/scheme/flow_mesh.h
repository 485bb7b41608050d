#pragma once

// A mesh as the flow solver sees it, of triangles and convex quadrilaterals: edges with the normals of the
// median dual, rings with gradient weights, boundary edges with what they are. Source: T. J. Barth and D. C.
// Jespersen, "The design and application of upwind schemes on unstructured meshes", AIAA paper 89-0366, 1989.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "flow/physics/boundary/patch.h"
#include "flow/scheme/periodic.h"
#include "flow/scheme/wall_bulge.h"
#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel::flow {

struct DualEdge {
  std::uint32_t a, b;      // a < b
  Point normal;            // of the dual face between them, from a to b; its length is the face's
  std::uint32_t place[2];  // where the edge lies: a and b, or images of them
};

// One neighbour of a vertex.
struct RingEntry {
  std::uint32_t vertex;
  std::uint32_t edge;
  Point weight;  // the gradient at the vertex is the sum of weight * (value there - value here)
};

struct BoundaryEdge {
  std::uint32_t a, b;       // the domain on the left
  Point normal;             // outwards; its length is the edge's
  std::uint32_t patch;      // index in FlowMesh::patches()
  bool of_triangle = true;  // or of a quadrilateral
  // Outer normals of the halves at a and at b, which meet in the edge's middle or, on walls, beside it: see
  // wall_bulge.h.
  Point half[2] = {};
  std::uint32_t place[2] = {a, b};  // where the edge lies: a and b, or images of them
};

// The largest distance between two vertices of a set, and which these are.
struct Extent {
  double length = 0.0;
  std::uint32_t a = no_index, b = no_index;
};

// Three or four corners, counter-clockwise; the fourth of a triangle is no_index.
struct Cell : std::array<std::uint32_t, 4> {
  std::uint32_t corners() const { return back() == no_index ? 3 : 4; }
};

class FlowMesh {
 public:
  // Every boundary edge of the mesh belongs to a named boundary: to one of `patches`, or else to a wall that
  // the flow slips along. Edges with the domain on both sides are no boundary. Throws Error (argument) naming
  // `source` where the mesh lacks the boundary of a patch (it may do without a far field of one part if there
  // are other patches), an edge has no name, a point is of no cell, a cell is not counter-clockwise and
  // convex, or periodic boundaries do not fit.
  FlowMesh(std::vector<Point> points, std::vector<Cell> cells, const std::vector<FrozenBoundary>& boundaries,
           std::vector<Patch> patches, const std::string& source);
  FlowMesh(const FrozenMesh& mesh, std::vector<Patch> patches, const std::string& source)
      : FlowMesh(mesh.points, cells_of(mesh), mesh.boundaries, std::move(patches), source) {}
  FlowMesh(const FrozenMesh& mesh, const std::string& farfield, const std::string& source)
      : FlowMesh(mesh, std::vector<Patch>{{farfield, FarField{}}}, source) {}
  // Throws Error (argument) where the far field is the only boundary.
  void require_walls(const std::string& source) const;
  // Throws Error (argument) where the far field, or a part of it, bounds a hole of the domain.
  void require_farfield_around(const std::string& source) const;
  // Throws Error (argument) where a cell is clockwise, not convex or has next to no area.
  void require_cells(const std::string& source) const;
  // Walls that the flow slips along become walls that it sticks to.
  void stick_to_walls();
  // Whether periodic boundaries make the vertex the same as another one, its original (periodic.h). Images
  // have no edges, no area and no neighbours; cells() and points() have them as the mesh does.
  bool is_image(std::size_t v) const { return original(static_cast<std::uint32_t>(v)) != v; }
  std::uint32_t original(std::uint32_t v) const {
    return periodic_.original.empty() ? v : periodic_.original[v];
  }
  // The other one of an image and its original; the vertex itself where there is none.
  std::uint32_t counterpart(std::uint32_t v) const {
    return periodic_.counterpart.empty() ? v : periodic_.counterpart[v];
  }
  bool has_images() const { return !periodic_.original.empty(); }
  const std::vector<PeriodicPairing>& periodic_pairs() const { return periodic_.pairs; }
  // From its first end to its second.
  Point vector(const DualEdge& edge) const { return points_[edge.place[1]] - points_[edge.place[0]]; }
  // The same cells with vertices elsewhere. Throws Error (argument) naming `source` where periodic boundaries
  // do not fit any more.
  void move(std::span<const Point> points, const std::string& source = "mesh");

  bool has_farfield() const { return has_farfield_; }
  std::size_t size() const { return points_.size(); }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<double>& areas() const { return areas_; }  // of dual cells
  const std::vector<DualEdge>& edges() const { return edges_; }
  // A function's derivatives by what this class makes of places.
  struct Slopes {
    std::vector<Point> normal;  // by dual faces, one each of edges()
    std::vector<Point> weight;  // by gradient weights, of ring(), one vertex after the other
    // By boundary edges, one each of boundary(): normals of both halves and of the edge.
    struct OfBoundary {
      Point half[2] = {}, normal = {};
    };
    std::vector<OfBoundary> boundary;
  };
  // Adds the function's derivatives by the coordinates; where `slopes` lacks dual faces and gradient weights,
  // the function has none.
  void add_slopes(const Slopes& slopes, std::vector<Point>& points) const;
  // Where a vertex's neighbours begin in by_weight.
  std::size_t ring_begin(std::size_t v) const { return ring_start_[v]; }
  // Neighbours of a vertex, ascending.
  std::span<const RingEntry> ring(std::size_t v) const {
    return {ring_.data() + ring_start_[v], ring_start_[v + 1] - ring_start_[v]};
  }
  const std::vector<BoundaryEdge>& boundary() const { return boundary_; }
  // Those that were given, in their order, then walls.
  const std::vector<Patch>& patches() const { return patches_; }
  const Patch& patch(const BoundaryEdge& edge) const { return patches_[edge.patch]; }
  bool one_sided(std::size_t v) const { return one_sided_[v]; }  // whether a patch of it is
  const Extent& extent() const { return extent_; }               // of the walls: see wall_extent.h
  const std::vector<Cell>& cells() const { return cells_; }
  static std::vector<Cell> cells_of(const FrozenMesh& mesh);
  std::vector<std::array<std::uint32_t, 3>> triangles() const;  // quadrilaterals in halves

 private:
  void make_edges(const std::string& source);
  void require_apart(const DualEdge& edge, std::uint32_t p, std::uint32_t q, const std::string& source) const;
  void require_free_ends(const std::string& source) const;
  void require_sides(const std::string& source) const;
  void make_boundary(const std::vector<FrozenBoundary>& boundaries, const std::string& source);
  void link_walls();
  void measure();
  double corner_area(const Cell& cell, std::uint32_t corner) const;
  std::uint32_t ring_entry(std::uint32_t v, std::uint32_t edge) const;
  void bend_walls();
  void add_boundary_slopes(const Slopes& slopes, std::vector<Point>& points) const;
  void add_inner_slopes(const Slopes& slopes, std::vector<Point>& points) const;
  // The outward move of the middle of boundary edge i, over its length.
  template <class T>
  T bulge(std::size_t i) const;

  std::vector<Point> points_;
  std::vector<Cell> cells_;
  PeriodicVertices periodic_;
  std::vector<std::array<std::uint32_t, 4>> cell_edges_;  // edge i joins corner i and the next one
  std::vector<DualEdge> edges_;
  std::vector<std::uint32_t> ring_start_;
  std::vector<RingEntry> ring_;
  std::vector<double> areas_;
  std::vector<double> around_;  // areas of the triangles of corners and their neighbours, around each vertex
  std::vector<BoundaryEdge> boundary_;
  // Per boundary edge: the wall's vertices before a and after b (no_index: none, or the edge is of no wall),
  // and the edge of edges_ that it is.
  struct WallLink {
    std::uint32_t before = no_index, after = no_index, edge = no_index;
  };
  std::vector<WallLink> links_;
  std::vector<bool> one_sided_;
  std::vector<Patch> patches_;
  bool has_farfield_ = false;
  Extent extent_;
};

template <class T>
T FlowMesh::bulge(std::size_t i) const {
  const std::uint32_t corners[4] = {links_[i].before, boundary_[i].a, boundary_[i].b, links_[i].after};
  std::array<T, 8> p = {};
  for (std::size_t k = 0; k < 4; ++k) {
    if (corners[k] == no_index) continue;
    const Point at = points_[corners[k]];
    if constexpr (std::is_same_v<T, double>) {
      p[2 * k] = at.x, p[2 * k + 1] = at.y;
    } else {
      p[2 * k] = T::variable(at.x, 2 * k), p[2 * k + 1] = T::variable(at.y, 2 * k + 1);
    }
  }
  return bulge_factor(boundary_[i].of_triangle) *
         wall_bulge<T>(p, corners[0] != no_index, corners[3] != no_index);
}

}  // namespace remodel::flow
