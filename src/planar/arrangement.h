#pragma once

// The arrangement of a planar graph: its segments as constrained edges of a triangulation, split where they
// meet.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "remodel/planar.h"
#include "triangulation/triangulation.h"

namespace remodel {

class Arrangement {
 public:
  // Throws Error as planar_domain() does.
  Arrangement(const PlanarGraph& graph, std::string source, Crossings crossings, double join);

  // The pieces of the segments, by their two vertices, the smaller first: the marker of the first segment
  // there that has one.
  using Key = std::pair<VertexId, VertexId>;
  const std::map<Key, int>& edges() const { return edges_; }
  const std::vector<VertexId>& vertices() const { return vertices_; }  // of the graph's points
  Point point(VertexId v) const { return triangulation_.point(v); }

  // Whether the plane beside the directed edge, or around a vertex without edges, belongs to the domain: it
  // is enclosed, and in no hole.
  bool domain_on_left(VertexId from, VertexId to) const;
  bool domain_around(VertexId v) const { return !outside_[triangulation_.star(v).triangle.index]; }

  // The name of the part of the domain beside the directed edge; empty where it has none.
  const std::string& region_on_left(VertexId from, VertexId to) const;

  PlanarFindings findings;

 private:
  struct Piece {
    VertexId from, to;
    int marker;
    std::size_t segment;
  };
  void insert_points();
  void insert_segment(Piece piece);
  void route(const Piece& piece, VertexId through);
  void add(const Piece& piece);
  bool is_near(VertexId v, VertexId from, VertexId to) const;
  VertexId vertex_near(const Piece& piece) const;
  void lead_through(VertexId v);
  void cross(const Piece& piece, VertexId first, VertexId second);
  VertexId vertex_at(Point p, VertexId near);
  void split_edge_at(VertexId v);
  void mark_outside();
  void mark_regions();
  template <class Enter>
  void spread_from(TriangleId start, Enter&& enter) const;
  TriangleId triangle_at(Point p) const;
  void count_as_joined(const Piece& piece, VertexId through);
  Point crossing_of(const Piece& piece, VertexId first, VertexId second) const;
  std::string name_of_segment(std::size_t segment) const;

  const PlanarGraph& graph_;
  std::string source_;
  Crossings policy_;
  Triangulation triangulation_;
  std::vector<VertexId> vertices_;
  std::map<Key, int> edges_;
  std::map<Key, std::size_t> segment_of_;
  std::vector<Piece> todo_;
  double snap_ = 0.0;
  std::size_t first_crossing_ = 0;     // vertices from here on are crossings
  std::vector<bool> outside_;          // per triangle slot
  std::vector<std::uint32_t> region_;  // per triangle slot: index in region_names_
  std::vector<std::string> region_names_{""};
};

}  // namespace remodel
