#pragma once

// A mesh as the Euler solver sees it: edges with the normals of the median dual, rings with gradient weights,
// boundary edges with what they are. Source: T. J. Barth and D. C. Jespersen, "The design and application of
// upwind schemes on unstructured meshes", AIAA paper 89-0366, 1989.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel::flow {

struct DualEdge {
  std::uint32_t a, b;  // a < b
  Point normal;        // of the dual face between them, from a to b; its length is the face's
};

// One neighbour of a vertex.
struct RingEntry {
  std::uint32_t vertex;
  std::uint32_t edge;
  Point weight;  // the gradient at the vertex is the sum of weight * (value there - value here)
};

struct BoundaryEdge {
  std::uint32_t a, b;  // the domain on the left
  Point normal;        // outwards; its length is the edge's
  std::int32_t body;   // index of the wall it belongs to, -1: far field, -2 - i: opening i
};

class FlowMesh {
 public:
  // Every boundary edge of the mesh belongs to a named boundary; the one called `farfield` is the far field,
  // those called like one of `openings` are inlets or outlets, all others are walls. Edges with the domain on
  // both sides are no boundary. Throws Error (argument) naming `source` where there is no far field (and no
  // opening), no boundary of an opening's name, an edge without a name, or a point of no triangle.
  FlowMesh(const FrozenMesh& mesh, const std::string& farfield, const std::string& source,
           std::span<const std::string> openings = {});
  // Throws Error (argument) where the far field is the only boundary.
  void require_walls(const std::string& source) const;
  // The same triangles with vertices elsewhere.
  void move(std::span<const Point> points);

  bool has_farfield() const { return has_farfield_; }
  std::size_t size() const { return points_.size(); }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<double>& areas() const { return areas_; }  // of dual cells
  const std::vector<DualEdge>& edges() const { return edges_; }
  // Adds to `points` the derivatives by the coordinates of a function whose derivatives by the normals of
  // dual faces (edges()) and by gradient weights (ring(), one vertex after the other) are these.
  void add_slopes(std::span<const Point> by_normal, std::span<const Point> by_weight,
                  std::vector<Point>& points) const;
  // Where a vertex's neighbours begin in by_weight.
  std::size_t ring_begin(std::size_t v) const { return ring_start_[v]; }
  // Neighbours of a vertex, ascending.
  std::span<const RingEntry> ring(std::size_t v) const {
    return {ring_.data() + ring_start_[v], ring_start_[v + 1] - ring_start_[v]};
  }
  const std::vector<BoundaryEdge>& boundary() const { return boundary_; }
  const std::vector<std::string>& bodies() const { return bodies_; }  // names of walls
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

 private:
  void make_edges();
  void make_boundary(const FrozenMesh& mesh, const std::string& farfield, const std::string& source,
                     std::span<const std::string> openings);
  void measure();

  std::vector<Point> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::array<std::uint32_t, 3>> triangle_edges_;  // edge i joins corners i and i + 1
  std::vector<DualEdge> edges_;
  std::vector<std::uint32_t> ring_start_;
  std::vector<RingEntry> ring_;
  std::vector<double> areas_;
  std::vector<BoundaryEdge> boundary_;
  std::vector<std::string> bodies_;
  bool has_farfield_ = false;
};

}  // namespace remodel::flow
