#pragma once

// The living mesh as the library sees it: a triangulation, the discretised boundary of a domain in it, and
// the promises it keeps. Stages (generation, remodelling) work on this; users see Mesh.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/slot_map.h"
#include "mesh/arena.h"
#include "mesh/bad_triangles.h"
#include "mesh/boundary_table.h"
#include "mesh/change_record.h"
#include "remodel/domain.h"
#include "remodel/mesh.h"
#include "remodel/mesh_state.h"
#include "triangulation/triangulation.h"

namespace remodel {

// What lies beside a loop, looking along it.
struct Sides {
  Region left = Region::outside, right = Region::outside;
};

// What a later stage keeps with a mesh to be faster next time. Never copied, never part of the state.
struct MeshCache {
  virtual ~MeshCache() = default;
  bool stale = false;  // connectivity has changed since it was made
};

// The bounds of QualityOptions in the form that tests use. They are stricter by one part in 10^9 than what is
// promised, so that whoever measures a mesh with rounding of his own finds the promise kept.
struct QualityBounds {
  // What a mesh promises whose kept triangles may take `keep` times H.
  QualityBounds(const QualityOptions& options, double keep);
  // What refinement makes: at least as strict as any promise.
  static QualityBounds of_refinement(const QualityOptions& options);
  double squared_radius_edge;  // B^2
  double squared_gradation;    // (keep H)^2; H^2 of refinement
};

// Storage of what a step may have to give back: step/step_journal.h. It lies with the mesh so that steps need
// nothing of the heap.
struct StepBackup {
  std::vector<std::uint32_t> loop_heads;
  std::vector<Sides> sides;
  std::vector<std::size_t> changing;  // the loops that the step may change, if not all in any way
  std::vector<Loop> loops;            // of the domain: those, or all
  RenewalState renewal;
};

// What the mesh of a design is the morph of (Strategy::reference): where the vertices were, slot by slot,
// when the mesh was Delaunay, with the connectivity that it has.
struct MeshReference {
  std::vector<Point> points;
  std::vector<double> length_scales;
  Domain domain;
};

class MeshData {
 public:
  Triangulation triangulation;
  Domain domain;
  QualityOptions options;
  BoundaryTable boundary;                 // see walk()
  std::vector<std::uint32_t> loop_heads;  // boundary index of each loop's first station
  std::vector<Sides> sides;               // of each loop
  std::size_t domain_triangles = 0;
  std::uint32_t step = 0;
  // Kept triangles are promised r / mean LS <= keep H, new ones H: 1, until a step of Strategy::renew raises
  // it.
  double keep = 1.0;
  // Why refinement of the whole mesh ended. Where a limit did it, bad triangles may be anywhere.
  Stopped stopped = Stopped::done;
  RenewalState renewal;
  ImportRecord imported;
  // Where there is one, opposite angles may sum up to 180 degrees and this slack.
  std::shared_ptr<const MeshReference> reference;
  double delaunay_slack_deg = 0.0;
  std::unique_ptr<MeshCache> cache;
  std::unique_ptr<MeshCache> follow_cache;  // of Strategy::reference
  // Whether all triangles outside the domain are known to be Delaunay, and the hull convex. Full adjustments
  // and held meshes leave them as they are, so that steps that replace vertices restore them first. Copies do
  // not know.
  bool outside_restored = false;
  ChangeRecords marked;  // of this mesh alone: copies begin without

  // Scratch: storage that is kept, so that steps need nothing of the heap.
  SlotSet<TriangleId> seen_triangles;  // by the search under way
  SlotSet<VertexId> seen_vertices;
  SlotSet<VertexId> inside_regions;                     // of removal
  SlotMap<TriangleId, std::uint32_t> affected_indices;  // in the list of an adjustment
  SlotMap<VertexId, std::uint32_t> candidate_indices;   // in the list of coarsening
  BadTriangles bad_triangles;                           // none when no refinement is under way
  Cavity cavity;                                        // of refinement, and the length scales of its ring
  Buffer<double> ring_scales;
  Arena arena;        // for lists of the step under way
  StepBackup backup;  // of the step under way

  MeshData() = default;
  MeshData(const MeshData& other);  // under a journal: a copy as if it were committed
  MeshData& operator=(const MeshData&) = delete;

  QualityBounds promised_bounds() const { return {options, keep}; }
  Point point(std::uint32_t k) const { return triangulation.point(boundary[k].vertex); }
  double length_scale(std::uint32_t k) const { return triangulation[boundary[k].vertex].length_scale; }
  const BoundaryVertex& at(std::uint32_t k) const { return boundary[k]; }

  // The domain's curves by index over all loops, without a search. Domains of the same structure need no new
  // index.
  void index_curves();
  std::size_t loop_of(std::uint32_t curve) const { return curve_places_[curve].loop; }
  const Curve& curve(std::uint32_t index) const {
    return domain.loops[curve_places_[index].loop].curves[curve_places_[index].position];
  }
  Point on_curve(std::uint32_t index, double t) const {
    return Frame(domain.loops[loop_of(index)].placement)(point_at(curve(index).shape, t));
  }

  // Visits the entries of a loop or chain in order, from its head: visit(k).
  template <class Visit>
  void walk(std::uint32_t head, Visit visit) const {
    std::uint32_t k = head;
    do {
      visit(k);
      k = boundary[k].next;
    } while (k != head && k != no_index);
  }
  // Visits its edges: visit(k, next of k). Entries added behind k meanwhile are visited too.
  template <class Visit>
  void walk_edges(std::uint32_t head, Visit visit) const {
    std::uint32_t k = head;
    while (boundary[k].next != no_index) {
      const std::uint32_t next = boundary[k].next;
      visit(k, next);
      k = boundary[k].next;
      if (k == head) break;
    }
  }
  // Visits all entries at the vertex of entry k, k first.
  template <class Visit>
  void at_vertex(std::uint32_t k, Visit visit) const {
    std::uint32_t e = k;
    do {
      visit(e);
      e = boundary[e].twin;
    } while (e != k);
  }
  // The boundary edge between two vertices, by the entry where it begins; no_index if there is none.
  std::uint32_t edge_between(VertexId a, VertexId b) const;

  // The curve parameter where the boundary edge from k ends: its next vertex's, or 1 where the curve ends
  // there.
  double end_parameter(std::uint32_t k) const;
  // Adds an entry behind `previous` (no_index: alone in a new chain); returns its index. A loop is closed
  // when all of its stations are there.
  std::uint32_t add_boundary_vertex(BoundaryVertex vertex, std::uint32_t previous);
  void close_loop(std::uint32_t head, std::uint32_t last);
  // Takes it out of its loop. Precondition: a Steiner vertex.
  void remove_boundary_vertex(std::uint32_t k);
  // The diagonal of the box of all boundary vertices; kept until a loop moves that may be the outermost.
  double extent() const;
  // No edge is made on purpose that is shorter than this: QualityOptions::min_edge, or where that is 0 a
  // small part of the domain's size or of its largest coordinate. Never less than 64 times the spacing of
  // doubles at that coordinate, below which points of a mesh cannot be told apart.
  double shortest_edge() const;
  void loop_moved(std::size_t loop) {
    if (domain.loops[loop].role != LoopRole::hole) forget_extent();
  }
  void forget_extent() { extent_ = largest_coordinate_ = -1.0; }

  // Sets the sides from the roles and the vertices of the loops: of all, or of one.
  void orient_loops();
  void orient_loop(std::size_t loop);
  // Labels all triangles from the constrained edges of all loops: O(triangles). False where loops contradict
  // each other.
  bool label_regions();
  std::size_t count_domain_triangles() const;  // O(triangles), as domain_triangles has it

  // What the curves alone say of the length scale at k: for a non-Steiner vertex the distance to the nearest
  // non-Steiner neighbour over R (equation LS_b; on all of its loops), for a Steiner vertex the interpolation
  // by length between its two non-Steiner neighbours (equation LS_bs; chords for arcs, between whose length
  // ratios the difference is of second order). 1 for a single point, which has none: its factor is its length
  // scale.
  double base_length_scale(std::uint32_t k) const;
  // Whether no boundary edge ends at the vertex of k.
  bool is_single_point(std::uint32_t k) const;
  std::uint32_t non_steiner_before(std::uint32_t k) const {  // no_index at the end of a chain
    return boundary[k].steiner ? boundary[k].station : boundary[k].previous_station;
  }
  std::uint32_t non_steiner_after(std::uint32_t k) const {
    return boundary[boundary[k].station].next_station;
  }
  // Sets the length scale, and the factor from it.
  void set_boundary_length_scale(std::uint32_t k, double value);

 private:
  struct CurvePlace {
    std::uint32_t loop, position;
  };
  std::vector<CurvePlace> curve_places_;
  void measure_extent() const;
  mutable double extent_ = -1.0;              // negative: unknown
  mutable double largest_coordinate_ = -1.0;  // of the corners of that box; known with it
};

// Empty, or what is wrong with the boundary: vertices on the design's curves, edges there and constrained,
// the domain on its side.
std::string check_boundary(const MeshData& mesh);

// The largest squared radius that both bounds allow a triangle with this shortest edge (squared) and this sum
// of length scales.
inline double largest_squared_radius(double shortest, double scales, const QualityBounds& bounds) {
  const double mean = scales * (1.0 / 3.0);
  return std::min(bounds.squared_radius_edge * shortest, bounds.squared_gradation * (mean * mean));
}

// A length scale between two others, by the lengths to them.
inline double interpolated_scale(double scale_before, double to_before, double scale_after, double to_after) {
  return (scale_before * to_after + scale_after * to_before) / (to_before + to_after);
}

inline double squared_shortest_edge(Point a, Point b, Point c) {
  return std::min({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)});
}

// The same of a triangle's corners.
inline double largest_squared_radius(const Vertex& a, const Vertex& b, const Vertex& c,
                                     const QualityBounds& bounds) {
  return largest_squared_radius(squared_shortest_edge(a.point, b.point, c.point),
                                a.length_scale + b.length_scale + c.length_scale, bounds);
}

// Whether a triangle keeps both bounds; the same as badness <= 1 up to the last rounding, without a division.
inline bool is_good(const Vertex& a, const Vertex& b, const Vertex& c, double squared_radius,
                    const QualityBounds& bounds) {
  return squared_radius <= largest_squared_radius(a, b, c, bounds);
}

// Whether p lies strictly inside the diametral circle of the segment a-b.
inline bool encroaches(Point p, Point a, Point b) {
  return dot(a - p, b - p) < 0.0;
}

// The largest of the two squared ratios over their squared bounds: above 1 the triangle is bad.
double badness(const Vertex& a, const Vertex& b, const Vertex& c, double squared_radius,
               const QualityBounds& bounds);
double badness(const Triangulation& triangulation, const Triangle& triangle, const QualityBounds& bounds);

// The measures of a finite triangle, from its corners.
struct TriangleMeasures {
  double squared_radius, squared_shortest;  // of the circumcircle; edge
};
TriangleMeasures measure(const Triangulation& triangulation, const Triangle& triangle);
// The smallest angle, in degrees, of triangles whose largest (radius / shortest edge)^2 this is; 0 for none.
double angle_of(double squared_radius_edge);

}  // namespace remodel
