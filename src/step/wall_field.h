#pragma once

// The field of remodel/displacement.h: what the edges of all walls, some of them moving, displace the
// interior by.
//
// Words: an *edge* is a boundary edge, or a single point. A *node* of the tree is a run of edges of one loop,
// which is taken together where it is seen under a small angle. Nodes are in depth-first order: behind a node
// its first half, then its second.

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "mesh/mesh_data.h"

namespace remodel {

class WallField {
 public:
  // R over the extent of the largest loop that moves, the diagonal of its box; and the largest angle, as a
  // tangent, under which a run of edges counts as one.
  static constexpr double radius = 0.5;
  static constexpr double opening = 0.35;

  struct Edge {
    VertexId a, b;
    Point from, to;
    double length;
  };
  // A wall or a part of it: edges one behind the other, or a single point, which is an edge of no extent with
  // its length scale for a length.
  struct Run {
    std::vector<Edge> edges;
    bool moving;
  };
  explicit WallField(const std::vector<Run>& runs);
  // The loops of a mesh, at these places of its vertices, by slot; where none are given, at those that they
  // have now. `moving` ascends.
  WallField(const MeshData& mesh, std::span<const std::size_t> moving, std::span<const Point> points = {});

  // Sets the displacements of the walls' vertices: of(vertex).
  template <class Of>
  void displace(Of of) {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (moving_[i]) set(i, of(edges_[i].a), of(edges_[i].b));
    gather();
  }
  // The displacement at x. Exactly zero beyond reach of the walls that move.
  Point at(Point x) const;
  // The same in two parts: what x sees does not depend on displacements. Appends it; nothing beyond reach.
  struct Sight {
    std::uint32_t node;
    double weight;
  };
  void look(Point x, std::vector<Sight>& sights) const;
  Point at(Point x, std::span<const Sight> sights) const;
  // The transpose: adds the derivative by the displacement at x to those by edges; at last, scatters these to
  // the ends of the edges: add(vertex, derivative).
  void pull(Point x, Point by_displacement);
  template <class Add>
  void scatter(Add add) {
    spread();
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (!moving_[i]) continue;
      const auto [a, b] = ends(i);
      add(edges_[i].a, a);
      add(edges_[i].b, b);
    }
  }

 private:
  // u_e + a_e (x - m_e) = constant + slope x, in complex numbers; of a node: times lengths, summed.
  struct Affine {
    Point constant{}, slope{};
  };
  struct Node {
    Point centre{};
    double near = 0.0;                  // squared distance within which it is opened; 0 of a single edge
    double length = 0.0;                // of its edges
    std::uint32_t after = 0;            // the node behind its last one
    std::uint32_t first = 0, last = 0;  // its edges
    bool moving = false;
  };

  void add_nodes(std::uint32_t first, std::uint32_t last);
  void set(std::size_t edge, Point a, Point b);
  void gather();
  void spread();
  std::pair<Point, Point> ends(std::size_t edge) const;
  static double squared_distance_to(const Edge& edge, Point x);
  bool beyond_reach(Point x) const;
  // Visits the nodes that x sees, each with its weight: visit(node, weight). Returns f(x) / sum of w.
  template <class Visit>
  double see(Point x, Visit visit) const;

  std::vector<Edge> edges_;
  std::vector<bool> moving_;  // of edges
  std::vector<Node> nodes_;
  std::vector<Affine> affine_;  // of nodes; derivatives by them while they are pulled
  std::vector<Affine> of_edges_;
  double least_ = 0.0;  // the sum of weights of moving walls at d = R
  Box box_;             // about the moving walls
  double squared_reach_ = 0.0;
};

}  // namespace remodel
