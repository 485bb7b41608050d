#pragma once

// Edges, neighbours, components and boundary loops, derived from the cells alone.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "check/report.h"
#include "remodel/frozen_mesh.h"

namespace remodel::checker {

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Cells are numbered triangles first. Which corner of one a point is.
using Corners = std::span<const std::uint32_t>;
std::size_t corner_of(Corners cell, std::uint32_t point);
inline std::uint32_t next_corner(Corners cell, std::size_t k) {
  return cell[(k + 1) % cell.size()];
}

struct Edge {
  std::uint32_t from = none, to = none;  // counter-clockwise in the cell on the left
  std::uint32_t left = none;             // a cell
  std::uint32_t right = none;            // a cell, or none on the boundary

  bool is_boundary() const { return right == none; }
};

class Topology {
 public:
  // Rule "adjacency": every edge is in one cell, or in two that pass it in opposite directions. Edges
  // that break it are left out.
  Topology(const FrozenMesh& mesh, Report& report);

  const std::vector<Edge>& edges() const { return edges_; }
  // Index of the edge between a and b in either direction, or none.
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const;
  // The cell across the edge from corner k to the next one, or none.
  std::uint32_t neighbour(std::uint32_t cell, std::size_t k) const { return neighbours_[cell][k]; }
  // The corner of a triangle opposite to the edge.
  std::uint32_t opposite(const Edge& edge, std::uint32_t triangle) const;

  // Parts of the mesh connected by edges.
  std::size_t component_count() const;
  // Boundary edges (indices) in order, the domain on their left: each loop follows the fans of its vertices.
  std::vector<std::vector<std::uint32_t>> loops() const;

 private:
  struct HalfEdge;
  std::uint32_t next_on_boundary(std::uint32_t edge) const;
  std::vector<HalfEdge> sorted_half_edges() const;
  void add_edge(const HalfEdge* first, const HalfEdge* last, Report& report);

  const FrozenMesh& mesh_;
  std::vector<Edge> edges_;  // in increasing order of their (smaller, larger) point
  std::vector<std::array<std::uint32_t, 4>> neighbours_;
};

}  // namespace remodel::checker
