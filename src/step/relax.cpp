#include "step/relax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/small_angles.h"
#include "remodel/predicates.h"

namespace remodel {

namespace {

// What the place of one vertex decides, in a form that is fast to ask for many places.
class Star {
 public:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  // False where the vertex is not to be moved: it has too many neighbours, or a triangle that may miss the
  // bound because of a small angle of the walls, and would be no such triangle after other moves.
  bool gather(const MeshData& mesh, const SmallAngles& small_angles, VertexId v) {
    const Triangulation& t = mesh.triangulation;
    count_ = 0;
    scale_ = t[v].length_scale;
    return !t.any_corner(v, [&](Corner c) {
      if (count_ == most_spokes || small_angles.exempt(t[c.triangle])) return true;
      Spoke& spoke = spokes_[count_++];
      const VertexId a = t.following(c), b = t.preceding(c);
      spoke.end = t.point(a);
      spoke.scale = t[a].length_scale;
      const Link rim = t.link(c);
      spoke.across = rim.constrained() ? 0.0 : cotangent(t.point(t.apex(rim)), t.point(b), spoke.end);
      return false;
    });
  }

  double shortest(Point p) const {
    double squared = infinite;
    for (std::size_t i = 0; i < count_; ++i) squared = std::min(squared, squared_distance(spokes_[i].end, p));
    return std::sqrt(squared);
  }

  // Whether all triangles are counter-clockwise, by exact predicates.
  bool surrounds(Point p) const {
    for (std::size_t i = 0; i < count_; ++i)
      if (orient2d(spokes_[i].end, spokes_[i + 1 == count_ ? 0 : i + 1].end, p) <= 0) return false;
    return true;
  }

  // The sum of squares at this place, or any number from `least` on if it is not less; infinite where a
  // triangle is not counter-clockwise.
  double penalty(Point p, const QualityBounds& bounds, double least) const {
    double sum = 0.0;
    const auto add = [&](double slack) {
      if (slack < margin) sum += (margin - slack) * (margin - slack);
    };
    std::array<double, most_spokes> right, left;  // cotangents at the ends of rim edge i
    for (std::size_t i = 0; i < count_; ++i) {
      const Spoke &a = spokes_[i], &b = spokes_[i + 1 == count_ ? 0 : i + 1];
      const Point to_a = a.end - p, to_b = b.end - p, rim = b.end - a.end;
      const double area = cross(to_a, to_b);
      if (!(area > 0.0)) return infinite;
      const double la = dot(to_a, to_a), lb = dot(to_b, to_b), lr = dot(rim, rim), over = 1.0 / area;
      const double limit = largest_squared_radius(std::min({la, lb, lr}), scale_ + a.scale + b.scale, bounds);
      add(1.0 - 0.25 * (la * over) * (lb * over) * lr / limit);
      add(dot(to_a, to_b) * over + a.across);
      if (sum >= least) return sum;
      right[i] = -dot(rim, to_a) * over;
      left[i] = dot(rim, to_b) * over;
    }
    for (std::size_t i = 0; i < count_; ++i)  // the spoke to spokes_[i].end
      add(right[i == 0 ? count_ - 1 : i - 1] + left[i]);
    return sum;
  }

 private:
  static constexpr double margin = 0.01;  // m: what is mended is off its bound by more than rounding
  static constexpr std::size_t most_spokes = 24;
  struct Spoke {
    Point end;
    double scale;
    double across;  // cotangent of the angle beyond the rim edge that begins here; 0 where it is constrained
  };
  static double cotangent(Point apex, Point a, Point b) {
    const Point to_a = a - apex, to_b = b - apex;
    return dot(to_a, to_b) / cross(to_a, to_b);
  }
  std::array<Spoke, most_spokes> spokes_;
  std::size_t count_ = 0;
  double scale_ = 0.0;
};

class Relaxation {
 public:
  Relaxation(MeshData& mesh, const QualityBounds& bounds, List<TriangleId>& triangles)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        bounds_(bounds),
        small_angles_(mesh),
        triangles_(triangles),
        queue_(&mesh.arena),
        moved_(&mesh.arena) {}

  bool run() {
    forget_queue();
    for (const TriangleId t : triangles_) consider(t);
    for (int sweep = 0; sweep < most_sweeps && !queue_.empty(); ++sweep) {
      const std::size_t before = queue_.size();
      moved_.clear();
      for (const VertexId v : queue_)
        if (improve(v)) moved_.push_back(v);
      forget_queue();
      const std::size_t first = triangles_.size();
      for (const VertexId v : moved_)
        triangulation_.for_each_corner(v, [&](Corner c) { refresh(c.triangle); });
      for (std::size_t i = first; i < triangles_.size(); ++i) consider(triangles_[i]);
      if (static_cast<double>(queue_.size()) > stalled * static_cast<double>(before)) break;
    }
    return queue_.empty();
  }

 private:
  static constexpr int most_sweeps = 8;
  static constexpr double stalled = 0.7;  // ends where a sweep leaves a larger share of what was to be done
  static constexpr int most_steps = 12;   // of one vertex in one sweep

  void forget_queue() {
    queue_.clear();
    mesh_.candidate_indices.clear(triangulation_.vertex_slots());
  }

  void refresh(TriangleId id) {
    triangulation_.set_moved(id, mesh_.step + 1);
    triangles_.push_back(id);
  }

  // Queues what can be moved where the triangle or an edge of it misses its bound.
  void consider(TriangleId id) {
    const Triangle& t = triangulation_[id];
    if (!t.in_domain()) return;
    if (badness(triangulation_, t, bounds_) > 1.0 && !small_angles_.exempt(t))
      for (const VertexId v : t.vertex) queue(v);
    for (int k = 0; k < 3; ++k) {
      const VertexId a = t.vertex[next3(k)], b = t.vertex[previous3(k)];
      if (t.link[k].constrained()) {
        if (encroaches(triangulation_.point(t.vertex[k]), triangulation_.point(a), triangulation_.point(b)))
          queue(t.vertex[k]);
        continue;
      }
      const VertexId across = triangulation_.apex(t.link[k]);
      if (squared_distance(t.circle.centre, triangulation_.point(across)) < t.circle.inside)
        queue(a), queue(b), queue(t.vertex[k]), queue(across);
    }
  }

  void queue(VertexId v) {
    if (triangulation_[v].boundary == no_index && mesh_.candidate_indices.insert(v, 0)) queue_.push_back(v);
  }

  // Compass search: to the best of eight places around, or nearer where none is much better. Whether it
  // moved.
  bool improve(VertexId v) {
    static constexpr double diagonal = 0.70710678118654752;
    static constexpr Point directions[] = {
        {1.0, 0.0},  {diagonal, diagonal},   {0.0, 1.0},  {-diagonal, diagonal},
        {-1.0, 0.0}, {-diagonal, -diagonal}, {0.0, -1.0}, {diagonal, -diagonal}};
    if (!star_.gather(mesh_, small_angles_, v)) return false;
    const Point start = triangulation_.point(v);
    Point best = start;
    double least = star_.penalty(start, bounds_, Star::infinite), reach = 0.1 * star_.shortest(start);
    for (int step = 0; step < most_steps && least > 0.0; ++step) {
      const Point from = best;
      const double before = least;
      for (const Point direction : directions) {
        const Point p = from + reach * direction;
        const double penalty = star_.penalty(p, bounds_, least);
        if (penalty < least) least = penalty, best = p;
      }
      if (least > 0.9 * before) reach *= 0.5;
    }
    if (best == start || !star_.surrounds(best)) return false;
    triangulation_.move(v, best, triangulation_[v].length_scale);
    return true;
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  const QualityBounds bounds_;
  const SmallAngles small_angles_;
  List<TriangleId>& triangles_;
  List<VertexId> queue_, moved_;
  Star star_;
};

}  // namespace

bool relax(MeshData& mesh, const QualityBounds& bounds, List<TriangleId>& triangles) {
  return Relaxation(mesh, bounds, triangles).run();
}

}  // namespace remodel
