#pragma once

// Delaunay refinement: new vertices at circumcentres of bad triangles until none is left. Sources: J.
// Ruppert, "A Delaunay Refinement Algorithm for Quality 2-Dimensional Mesh Generation", J. Algorithms 18,
// 1995; J. R. Shewchuk, "Delaunay refinement algorithms for triangular mesh generation", Comput. Geom. 22,
// 2002; the length scales of the paper's section 2.
//
// Words:
//  - A *segment* is a boundary edge: the chord of a piece of curve. It is *encroached* by a point strictly
//    inside its diametral circle, seen from the domain's side. The other side of a thin body does not count.
//  - A triangle of the domain is *bad* if r / e_min > B or r / mean LS > H, with r the circumradius, e_min
//    the shortest edge, LS the length scales of its corners. Its *badness* is the larger ratio over its
//    bound.
//  - The *cavity* of a point is the set of triangles whose circumcircles hold it. Constraints bound it. Its
//    edges are the *ring*.
//
// The loop (run()):
//
//   1. While a segment is queued: split it at the middle of its piece of curve. At a corner with a small
//      angle the split lies on a shell about the corner instead, so that two segments do not split each other
//      forever (mesh/small_angles.h).
//   2. Otherwise take the worst class of bad triangles (mesh/bad_triangles.h sorts them into classes, so that
//      a queue costs nothing), find the cavity of its circumcentre p, and
//        a. if p encroaches on a segment of the ring, or lies beyond one: queue that segment, and the
//           triangle again, instead of p;
//        b. otherwise fill the cavity by the star of p (picture in triangulation/insert.cpp). p gets the
//           length scale min over the ring of LS(u) + |up| / G. The new triangles are judged.
//   3. When nothing is queued: split periodic curves where their counterparts were split, and go on.
//   4. End when nothing is left, or at a limit: the number of vertices, or edges shorter than the shortest
//      that is allowed.
//
// Why it ends: no vertex is nearer to a circumcentre than r, so that for B >= sqrt(2) new edges are no
// shorter than a constant times the local feature size (Ruppert). For smaller B, and at small input angles,
// that is not proven: triangles at small angles are exempt, and min_edge ends the rest, with
// Stopped::minimum_edge.
//
// Curves make two differences from the papers. The new vertex of a segment lies on the curve, off the chord.
// Where it lies in one of the two triangles beside the chord the split is local (split()). Where curve and
// chord are further apart (a blunt leading edge, a cusp) the chord is released, the point inserted where it
// lies, and both halves recovered, which may split other segments first (split_far(), recover()).
//
// Three bounds: new triangles have to meet what refinement works to; kept ones what the mesh promises, which
// may be less (keep H, the angle without slack); morphed ones the promised angle and the kept gradation. A
// step says which by consider(), consider_kept(), consider_morphed().

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mesh/mesh_data.h"
#include "mesh/small_angles.h"

namespace remodel {

class Refiner {
 public:
  // Precondition: regions are labelled, length scales set, the triangulation is constrained Delaunay. Uses
  // the mesh's arena: within a scope of it.
  explicit Refiner(MeshData& mesh, StepObserver* observer = nullptr);
  // A limit or an exception leaves no marks behind.
  ~Refiner();
  Refiner(const Refiner&) = delete;
  Refiner& operator=(const Refiner&) = delete;

  // Queues a triangle that is bad, and its boundary edges that are encroached.
  void consider(TriangleId t) { consider(t, bounds_); }
  // The same for a triangle that need only keep what the mesh promises.
  void consider_kept(TriangleId t) { consider(t, promised_); }
  // The same for one that was made or moved by a morph: it may use the slack between the promised angle and
  // the one that refinement works to.
  void consider_morphed(TriangleId t) { consider(t, slack_); }
  // Refines until nothing queued is left or a limit is reached.
  Stopped run();

  // Makes every boundary edge of the given loop (by its head) an edge of the triangulation again: free
  // vertices on it are removed, boundary edges that cross it are split. Region labels are left to the caller.
  // Throws RecoveryError.
  void recover_loop(std::uint32_t head);
  void recover_edge(std::uint32_t k);  // the same for the edge from this entry

  std::size_t small_angles() const { return small_angles_.count(); }
  // Ends with Stopped::vertex_budget once the mesh has this many vertices.
  void limit_vertices(std::size_t count) { vertex_limit_ = count; }

 private:
  // A segment by its first entry in the boundary table and what followed it when it was queued.
  struct Segment {
    std::uint32_t from, to;
    std::optional<double> t = {};  // where it is to be split, if that is given
  };

  void consider(TriangleId t, const QualityBounds& bounds);
  // Marks a triangle, given the largest squared radius with which it is good.
  void mark(TriangleId t, double bound) {
    const std::uint8_t c = BadTriangles::class_of(triangulation_[t].circle.squared_radius(), bound);
    mesh_.bad_triangles.set(t, c);  // first: it may throw
    triangulation_.set_badness(t, c);
  }
  // The next triangle to refine, no longer marked; none if none is left.
  TriangleId next_bad();
  TriangleId next_candidate();
  bool segments_wait() const { return next_segment_ < segments_.size(); }
  void refine(TriangleId t);
  void judge_star(VertexId v);
  bool split_blocking_segments(Point p);
  bool sees_ring(Point p) const;
  void queue_segment(VertexId a, VertexId b);
  void refuse(Segment segment);
  bool is_refused(VertexId a, VertexId b) const;
  void split(Segment segment, int depth);
  // Queues splits of periodic curves at the vertices of their counterparts. True if there are any.
  bool queue_counterparts();
  void queue_counterparts(std::size_t curve, std::size_t other, const PeriodicCurve& pair);
  // Whether there is a small corner at this place of a curve, or at its counterpart: both are split alike.
  bool is_corner(VertexId v, std::uint32_t curve, double t) const;
  bool is_corner_at(std::size_t curve, double t) const;
  double split_parameter(Segment segment) const;
  std::uint32_t add_split(Segment segment, VertexId v, double t);
  double scale_between(VertexId v, VertexId a, VertexId b) const;
  void set_split_length_scale(std::uint32_t k, VertexId a, VertexId b);
  // These return the new entry of the boundary table.
  std::uint32_t split_far(Segment segment, Point p, double t, int depth);
  std::uint32_t try_split_far(Segment segment, Point p, double t);
  void recover(VertexId a, VertexId b, int depth);
  void clear_outside();
  void consider_star(VertexId v);
  bool cancelled() { return observer_ != nullptr && polls_++ % 1024 == 0 && observer_->cancelled(); }
  bool too_short(Point a, Point b) const;

  MeshData& mesh_;
  Triangulation& triangulation_;
  QualityBounds bounds_, promised_, slack_;  // of new triangles; of kept ones; of morphed ones
  double inverse_gradation_;
  SmallAngles small_angles_;
  std::vector<PeriodicCurve> periodic_;
  // Candidates on their way from memory: a pass jumps about in a large mesh, so what it will need is fetched
  // a few triangles ahead.
  static constexpr std::size_t look_ahead = 32;
  std::array<TriangleId, look_ahead> ahead_;
  std::size_t turn_ = 0;
  Cavity& cavity_;
  Buffer<double>& scales_;        // of its ring
  List<Segment> segments_;        // first in, first out
  std::size_t next_segment_ = 0;  // of those, the first that waits
  std::pmr::set<std::pair<VertexId, VertexId>> refused_segments_;
  double squared_min_edge_ = 0.0;
  std::size_t vertex_limit_;
  StepObserver* observer_;
  std::uint32_t polls_ = 0;
  bool waiting_ = false;  // something may be marked
  bool refused_ = false;  // a segment or a triangle was too small to be split
  bool labelled_ = true;  // false while boundaries are being recovered: the caller labels afterwards
};

}  // namespace remodel
