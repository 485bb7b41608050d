#pragma once

// The living mesh as the library sees it: a triangulation, the discretised boundary of a domain in it, and
// the promises it keeps. Stages (generation, remodelling) work on this; users see Mesh.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/arena.h"
#include "mesh/bad_triangles.h"
#include "mesh/boundary_table.h"
#include "remodel/domain.h"
#include "remodel/mesh.h"
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

// Which slots a search has visited. Forgetting costs nothing, so a small search in a large mesh stays small.
class Marks {
 public:
  void clear(std::size_t slots) {
    if (stamps_.size() < slots) stamps_.resize(slots, 0);
    if (++now_ == 0) std::fill(stamps_.begin(), stamps_.end(), 0), now_ = 1;
  }
  // True the first time since clear().
  bool visit(std::uint32_t slot) {
    if (stamps_[slot] == now_) return false;
    stamps_[slot] = now_;
    return true;
  }
  void prefetch(std::uint32_t slot) const { __builtin_prefetch(&stamps_[slot]); }
  bool visited(std::uint32_t slot) const { return stamps_[slot] == now_; }

 private:
  std::vector<std::uint32_t> stamps_;
  std::uint32_t now_ = 0;
};

// The bounds of QualityOptions in the form that tests use. They are stricter by one part in 10^9 than what is
// promised, so that whoever measures a mesh with rounding of his own finds the promise kept.
struct QualityBounds {
  explicit QualityBounds(const QualityOptions& options);
  // What refinement makes: at least as strict.
  static QualityBounds of_refinement(const QualityOptions& options);
  double squared_radius_edge;  // B^2
  double squared_gradation;    // (keep H)^2; H^2 of refinement
};

// What a step changes besides the triangulation and the boundary table, as it was before: see Transaction in
// remodel/. Kept with the mesh for its storage.
struct Backup {
  std::vector<std::uint32_t> loop_heads;
  std::vector<Sides> sides;
  std::vector<std::size_t> changing;  // the loops that the step may change, if not all in any way
  std::vector<Loop> loops;            // of the domain: those, or all
  RenewalState renewal;
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
  RenewalState renewal;
  ImportRecord imported;
  std::unique_ptr<MeshCache> cache;

  // Scratch of searches: visited triangles and vertices, and a number for each triangle.
  Marks marks;
  Marks vertex_marks;
  std::vector<std::uint32_t> numbers;
  BadTriangles bad_triangles;  // none when no refinement is under way
  Cavity cavity;               // of refinement, and the length scales of its ring
  Buffer<double> ring_scales;
  Arena arena;    // for lists of the step under way
  Backup backup;  // of the step under way

  MeshData() = default;
  MeshData(const MeshData& other);  // under a journal: a copy as if it were committed
  MeshData& operator=(const MeshData&) = delete;

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
  void loop_moved(std::size_t loop) {
    if (domain.loops[loop].role != LoopRole::hole) forget_extent();
  }
  void forget_extent() { extent_ = -1.0; }

  // Sets the sides from the roles and the vertices of the loops: of all, or of one.
  void orient_loops();
  void orient_loop(std::size_t loop);
  // Labels all triangles from the constrained edges of all loops: O(triangles). False where loops contradict
  // each other.
  bool label_regions();
  void count_domain_triangles();

  // What the curves alone say of the length scale at k: for a non-Steiner vertex the distance to the nearest
  // non-Steiner neighbour over R (equation LS_b; on all of its loops), for a Steiner vertex the interpolation
  // by length between its two non-Steiner neighbours (equation LS_bs; chords for arcs, between whose length
  // ratios the difference is of second order). 1 for a single point, which has none.
  double base_length_scale(std::uint32_t k) const;
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
  mutable double extent_ = -1.0;  // negative: unknown
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

// Whether a triangle keeps both bounds; the same as badness <= 1 up to the last rounding, without a division.
inline bool is_good(const Vertex& a, const Vertex& b, const Vertex& c, double squared_radius,
                    const QualityBounds& bounds) {
  const double shortest = std::min({squared_distance(a.point, b.point), squared_distance(b.point, c.point),
                                    squared_distance(c.point, a.point)});
  return squared_radius <=
         largest_squared_radius(shortest, a.length_scale + b.length_scale + c.length_scale, bounds);
}

// The largest of the two squared ratios over their squared bounds: above 1 the triangle is bad.
double badness(const Vertex& a, const Vertex& b, const Vertex& c, double squared_radius,
               const QualityBounds& bounds);
double badness(const Triangulation& triangulation, const Triangle& triangle, const QualityBounds& bounds);

// Of a finite triangle, from its corners.
struct TriangleMeasures {
  double squared_radius, squared_shortest;  // of the circumcircle; edge
};
TriangleMeasures measure(const Triangulation& triangulation, const Triangle& triangle);
// The smallest angle, in degrees, of triangles whose largest (radius / shortest edge)^2 this is; 0 for none.
double angle_of(double squared_radius_edge);

}  // namespace remodel
