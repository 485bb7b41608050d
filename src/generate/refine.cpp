#include "generate/refine.h"

#include <algorithm>
#include <cmath>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "generate/relabel.h"
#include "remodel/predicates.h"

namespace remodel {

namespace {

constexpr int max_depth = 12;  // of splits that other splits ask for: see split_far()
constexpr double same = 1e-9;  // parameters of counterparts

bool is_finite(Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace

Refiner::Refiner(MeshData& mesh, StepObserver* observer)
    : mesh_(mesh),
      triangulation_(mesh.triangulation),
      bounds_(QualityBounds::of_refinement(mesh.options)),
      promised_(bounds_),
      slack_(mesh.promised_bounds()),
      inverse_gradation_(1.0 / mesh.options.gradation),
      small_angles_(mesh),
      periodic_(periodic_curves(mesh.domain)),
      cavity_(mesh.cavity),
      scales_(mesh.ring_scales),
      segments_(&mesh.arena),
      refused_segments_(&mesh.arena),
      vertex_limit_(mesh.options.max_vertices),
      observer_(observer) {
  const double shortest = mesh.shortest_edge();
  squared_min_edge_ = shortest * shortest;
  promised_.squared_gradation = mesh.promised_bounds().squared_gradation;
}

// In the order of memory: to take them one by one in theirs takes a large mesh that was interrupted far
// longer.
Refiner::~Refiner() {
  if (!waiting_) return;
  for (std::uint32_t i = 0; i < triangulation_.triangle_slots(); ++i)
    if (const TriangleId t{i}; triangulation_[t].badness != 0) triangulation_.set_badness(t, 0);
  mesh_.bad_triangles = {};
}

bool Refiner::too_short(Point a, Point b) const {
  return squared_distance(a, b) < squared_min_edge_;
}

void Refiner::consider(TriangleId t, const QualityBounds& bounds) {
  const Triangle& triangle = triangulation_[t];
  if (!triangle.in_domain()) return;
  waiting_ = true;
  for (int i = 0; i < 3; ++i) {
    if (!triangle.link[i].constrained()) continue;
    const VertexId a = triangle.vertex[next3(i)], b = triangle.vertex[previous3(i)];
    if (encroaches(triangulation_.point(triangle.vertex[i]), triangulation_.point(a),
                   triangulation_.point(b)))
      queue_segment(a, b);
  }
  const Vertex &a = triangulation_[triangle.vertex[0]], &b = triangulation_[triangle.vertex[1]],
               &c = triangulation_[triangle.vertex[2]];
  mark(t, largest_squared_radius(a, b, c, bounds));
}

TriangleId Refiner::next_bad() {
  for (;;) {
    const TriangleId t = next_candidate();
    // A candidate's slot may have been written anew while it waited. Its record says whether it is still bad.
    if (t && triangulation_[t].badness == 0) continue;
    if (t) triangulation_.set_badness(t, 0);
    return t;
  }
}

// A small mesh lies in the caches, and so does what a step has changed: there the order is strict.
TriangleId Refiner::next_candidate() {
  if (triangulation_.triangle_slots() < 8192 || triangulation_.journalling())
    return mesh_.bad_triangles.take();
  for (std::size_t idle = 0; idle < look_ahead;) {
    const TriangleId t = ahead_[turn_], fetched = mesh_.bad_triangles.take();
    ahead_[turn_] = fetched;
    if (fetched) triangulation_.prefetch(fetched);
    idle = fetched ? 0 : idle + 1;
    const TriangleId later = ahead_[(turn_ + look_ahead / 2) % look_ahead];
    if (later && triangulation_[later].badness != 0) triangulation_.prefetch_around(later);
    const TriangleId soon = ahead_[(turn_ + look_ahead / 4) % look_ahead];
    if (soon && triangulation_[soon].badness != 0) triangulation_.prefetch_second_ring(soon);
    turn_ = (turn_ + 1) % look_ahead;
    if (t) return t;
  }
  return {};
}

void Refiner::queue_segment(VertexId a, VertexId b) {
  const std::uint32_t k = mesh_.edge_between(a, b);
  if (k != no_index && !is_refused(a, b)) segments_.push_back({k, mesh_.at(k).next});
}

// A segment that cannot be split is not asked again.
void Refiner::refuse(Segment segment) {
  refused_ = true;
  refused_segments_.insert(undirected(mesh_.at(segment.from).vertex, mesh_.at(segment.to).vertex));
}

bool Refiner::is_refused(VertexId a, VertexId b) const {
  return !refused_segments_.empty() && refused_segments_.contains(undirected(a, b));
}

Stopped Refiner::run() {
  for (;;) {
    if (triangulation_.vertex_count() >= vertex_limit_) return Stopped::vertex_budget;
    if (cancelled()) return Stopped::interrupted;
    if (segments_wait()) {
      split(segments_[next_segment_++], 0);
      continue;
    }
    if (const TriangleId t = next_bad())
      refine(t);
    else if (!queue_counterparts())
      break;
  }
  waiting_ = false;
  return refused_ ? Stopped::minimum_edge : Stopped::done;
}

// Step 1: the circumcentre's cavity. It need not hold the circumcentre: the bad triangle is always part of
// it. Step 2: a boundary edge of the cavity that the point encroaches on, or lies beyond, is split instead.
// Step 3: otherwise the point becomes a vertex.
//
// No vertex is nearer to a circumcentre than its radius: that is the length of the shortest new edge, and a
// limit on it ends the refinement for angles for which edges get ever shorter.
void Refiner::refine(TriangleId t) {
  const Triangle& triangle = triangulation_[t];
  if (small_angles_.exempt(triangle)) return;
  const Point p = triangle.circle.centre;
  const bool certain = triangle.circle.certain();
  if (!is_finite(p) || triangle.circle.squared_radius() < squared_min_edge_ ||
      !triangulation_.find_cavity(p, t, cavity_)) {
    refused_ = true;
    return;
  }
  if (split_blocking_segments(p)) {
    if (segments_wait()) consider(t);
    return;
  }
  if (!certain && !sees_ring(p)) {
    refused_ = true;
    return;
  }
  const VertexId v = triangulation_.fill_cavity(p, cavity_);
  judge_star(v);
}

// Whether p sees every edge of the ring from its left. It does where it lies at a circumcentre; of a sliver,
// the computed centre may be anywhere, on another vertex too.
bool Refiner::sees_ring(Point p) const {
  const std::size_t n = cavity_.ring.size();
  for (std::size_t k = 0; k < n; ++k) {
    const VertexId a = cavity_.ring[k].from, b = cavity_.ring[k + 1 == n ? 0 : k + 1].from;
    if (a == infinite_vertex || b == infinite_vertex) return false;
    if (orient2d(triangulation_.point(a), triangulation_.point(b), p) <= 0) return false;
  }
  return true;
}

// The length scale of a new vertex, from its ring, and the badness of the triangles at it.
void Refiner::judge_star(VertexId v) {
  const Spokes& spokes = triangulation_.spokes();
  const std::size_t n = spokes.size();
  scales_.resize(n);
  double scale = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    scales_[k] = triangulation_[cavity_.ring[k].from].length_scale;
    scale = std::min(scale, scales_[k] + spokes.length(k) * inverse_gradation_);
  }
  triangulation_.set_length_scale(v, scale);
  for (std::size_t k = 0; k < n; ++k) {
    const double scales = scale + (scales_[k] + scales_[k + 1 == n ? 0 : k + 1]);
    mark(cavity_.triangles[k], largest_squared_radius(spokes.squared_shortest(k), scales, bounds_));
  }
}

// Queues what p encroaches on, or failing that what lies between p and the cavity. True if p must not be
// inserted.
bool Refiner::split_blocking_segments(Point p) {
  if (!cavity_.constrained) return false;
  bool blocked = false;
  for (const bool beyond : {false, true}) {
    for (std::size_t k = 0; k < cavity_.ring.size(); ++k) {
      if (!cavity_.ring[k].outer.constrained()) continue;
      const VertexId a = cavity_.ring[k].from,
                     b = cavity_.ring[k + 1 == cavity_.ring.size() ? 0 : k + 1].from;
      const Point pa = triangulation_.point(a), pb = triangulation_.point(b);
      if (!(beyond ? orient2d(pa, pb, p) <= 0 : encroaches(p, pa, pb))) continue;
      blocked = true;
      if (too_short(pa, pb) || is_refused(a, b))
        refused_ = true;
      else
        queue_segment(a, b);
    }
    if (blocked) return true;
  }
  return false;
}

bool Refiner::queue_counterparts() {
  for (const PeriodicCurve& pair : periodic_) {
    queue_counterparts(pair.curve, pair.moved, pair);
    queue_counterparts(pair.moved, pair.curve, pair);
  }
  return segments_wait();
}

// Of those on the curve `other` that have none at their parameters yet. One of a segment at a time.
void Refiner::queue_counterparts(std::size_t curve, std::size_t other, const PeriodicCurve& pair) {
  std::vector<double> wanted;
  mesh_.walk_edges(mesh_.loop_heads[mesh_.domain.loop_of(other)], [&](std::uint32_t k, std::uint32_t) {
    if (mesh_.at(k).curve == other) wanted.push_back(pair.parameter(mesh_.at(k).t));
  });
  std::sort(wanted.begin(), wanted.end());
  mesh_.walk_edges(mesh_.loop_heads[mesh_.domain.loop_of(curve)], [&](std::uint32_t k, std::uint32_t next) {
    if (mesh_.at(k).curve != curve || is_refused(mesh_.at(k).vertex, mesh_.at(next).vertex)) return;
    const double t0 = mesh_.at(k).t, t1 = mesh_.end_parameter(k);
    const auto t = std::upper_bound(wanted.begin(), wanted.end(), t0 + same);
    if (t != wanted.end() && *t < t1 - same) segments_.push_back({k, next, *t});
  });
}

bool Refiner::is_corner(VertexId v, std::uint32_t curve, double t) const {
  if (small_angles_.is_corner(v)) return true;
  return std::any_of(periodic_.begin(), periodic_.end(), [&](const PeriodicCurve& pair) {
    return (pair.curve == curve && is_corner_at(pair.moved, pair.parameter(t))) ||
           (pair.moved == curve && is_corner_at(pair.curve, pair.parameter(t)));
  });
}

bool Refiner::is_corner_at(std::size_t curve, double t) const {
  bool found = false;
  mesh_.walk_edges(mesh_.loop_heads[mesh_.domain.loop_of(curve)], [&](std::uint32_t k, std::uint32_t next) {
    if (mesh_.at(k).curve != curve) return;
    if (std::fabs(mesh_.at(k).t - t) <= same)
      found = found || small_angles_.is_corner(mesh_.at(k).vertex);
    else if (std::fabs(mesh_.end_parameter(k) - t) <= same)
      found = found || small_angles_.is_corner(mesh_.at(next).vertex);
  });
  return found;
}

double Refiner::split_parameter(Segment segment) const {
  if (segment.t) return *segment.t;
  const double t0 = mesh_.at(segment.from).t, t1 = mesh_.end_parameter(segment.from);
  const std::uint32_t own = mesh_.at(segment.from).curve;
  const bool corner_first = is_corner(mesh_.at(segment.from).vertex, own, t0);
  const bool corner_last = is_corner(mesh_.at(segment.to).vertex, own, t1);
  if (corner_first == corner_last) return 0.5 * (t0 + t1);
  // On a shell about the small corner. Bisection for the distance, which grows along a segment's piece of
  // curve.
  const Point corner = mesh_.point(corner_first ? segment.from : segment.to);
  const Point other = mesh_.point(corner_first ? segment.to : segment.from);
  const double length = std::sqrt(squared_distance(corner, other));
  const double target = SmallAngles::shell_fraction(length) * length;
  double near = corner_first ? t0 : t1, far = corner_first ? t1 : t0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    (squared_distance(corner, mesh_.on_curve(own, middle)) < target * target ? near : far) = middle;
  }
  return far;
}

void Refiner::split(Segment segment, int depth) {
  if (mesh_.at(segment.from).next != segment.to) return;  // split meanwhile
  const VertexId a = mesh_.at(segment.from).vertex, b = mesh_.at(segment.to).vertex;
  const double t = split_parameter(segment);
  const Point p = mesh_.on_curve(mesh_.at(segment.from).curve, t);
  if (too_short(mesh_.point(segment.from), mesh_.point(segment.to)) || p == triangulation_.point(a) ||
      p == triangulation_.point(b)) {
    refuse(segment);
    return;
  }
  std::uint32_t k = no_index;
  if (const auto near = triangulation_.split(*triangulation_.find_edge(a, b), p))
    k = add_split(segment, *near, t);
  else if (depth > 0 || !labelled_ || triangulation_.journalling())
    k = split_far(segment, p, t, depth);
  else
    k = try_split_far(segment, p, t);
  if (k == no_index) return;
  set_split_length_scale(k, a, b);
  if (labelled_ && depth == 0) consider_star(mesh_.at(k).vertex);
}

std::uint32_t Refiner::add_split(Segment segment, VertexId v, double t) {
  return mesh_.add_boundary_vertex(
      {.vertex = v, .curve = mesh_.at(segment.from).curve, .t = t, .steiner = true}, segment.from);
}

// By length between the ends a and b of the segment that v splits.
double Refiner::scale_between(VertexId v, VertexId a, VertexId b) const {
  const Point p = triangulation_.point(v);
  const double to_a = std::sqrt(squared_distance(triangulation_.point(a), p));
  const double to_b = std::sqrt(squared_distance(triangulation_.point(b), p));
  return interpolated_scale(triangulation_[a].length_scale, to_a, triangulation_[b].length_scale, to_b);
}

// The interpolation between the ends a and b, and no more than what propagates from its neighbours.
void Refiner::set_split_length_scale(std::uint32_t k, VertexId a, VertexId b) {
  const VertexId v = mesh_.at(k).vertex;
  const Point p = triangulation_.point(v);
  double scale = scale_between(v, a, b);
  triangulation_.for_each_corner(v, [&](Corner c) {
    if (triangulation_[c.triangle].region != Region::domain) return;
    for (const VertexId u : {triangulation_.following(c), triangulation_.preceding(c)})
      scale = std::min(scale,
                       triangulation_[u].length_scale +
                           std::sqrt(squared_distance(triangulation_.point(u), p)) / mesh_.options.gradation);
  });
  mesh_.set_boundary_length_scale(k, scale);
}

// A far split that turns out impossible (boundaries closer to each other than points can be rounded) is taken
// back, and the segment counts as too short. Under a journal of the caller's it is the caller who takes it
// back.
std::uint32_t Refiner::try_split_far(Segment segment, Point p, double t) {
  triangulation_.begin();
  mesh_.boundary.begin();
  try {
    const std::uint32_t k = split_far(segment, p, t, 0);
    triangulation_.commit();
    mesh_.boundary.commit();
    return k;
  } catch (const RecoveryError&) {
    triangulation_.rollback();
    mesh_.boundary.rollback();
    refuse(segment);
    return no_index;
  }
}

void Refiner::consider_star(VertexId v) {
  triangulation_.for_each_corner(v, [&](Corner c) { consider(c.triangle); });
}

// The curve point lies beyond the triangles next to its chord (blunt leading edges, cusps): free vertices lie
// between chord and curve, or another boundary edge does. The chord is given up, the point inserted where it
// is, and both halves are recovered.
std::uint32_t Refiner::split_far(Segment segment, Point p, double t, int depth) {
  if (depth > max_depth) throw RecoveryError("boundary splits ask for each other without end");
  const bool outermost = labelled_ && depth == 0;  // deeper, the edges that asked for this split are missing
  if (outermost) triangulation_.mark();
  const VertexId a = mesh_.at(segment.from).vertex, b = mesh_.at(segment.to).vertex;
  triangulation_.release(a, b);
  const VertexId v = insert_boundary_point(triangulation_, p, a);
  triangulation_.set_length_scale(v, scale_between(v, a, b));  // splits that recovery asks for look at it
  const std::uint32_t k = add_split(segment, v, t);
  recover(a, v, depth);
  recover(v, b, depth);
  if (outermost) clear_outside();
  return k;
}

void Refiner::recover_loop(std::uint32_t head) {
  mesh_.walk_edges(head, [&](std::uint32_t k, std::uint32_t) { recover_edge(k); });
}

void Refiner::recover_edge(std::uint32_t k) {
  const VertexId a = mesh_.at(k).vertex, b = mesh_.at(mesh_.at(k).next).vertex;
  const auto edge = triangulation_.find_edge(a, b);
  if (edge && triangulation_.link(*edge).constrained()) return;
  labelled_ = false;
  recover(a, b, 0);
  labelled_ = true;
}

// Makes a-b a constrained edge: free vertices on it are removed, boundary edges that cross it are split
// first.
void Refiner::recover(VertexId a, VertexId b, int depth) {
  for (int attempt = 0; attempt < 64; ++attempt) {
    const ConstrainResult result = triangulation_.constrain(a, b);
    if (result.kind == ConstrainResult::Kind::done) return;
    if (result.kind == ConstrainResult::Kind::vertex) {
      if (result.first == infinite_vertex || triangulation_[result.first].boundary != no_index)
        throw RecoveryError("a boundary edge runs through another boundary vertex");
      triangulation_.remove(result.first);
      continue;
    }
    if (!result.first) throw RecoveryError("a boundary edge leaves the hull");
    const std::uint32_t k = mesh_.edge_between(result.first, result.second);
    split({k, mesh_.at(k).next}, depth + 1);
  }
  throw RecoveryError("a boundary edge cannot be recovered");
}

// After a far split: what changed may lie on another side of the boundary now, and free vertices outside go.
void Refiner::clear_outside() {
  {
    const Arena::Scope scope(mesh_.arena);  // not of what consider() queues
    relabel(mesh_, alive_since_mark(mesh_));
  }
  for (const TriangleId t : triangulation_.touched_since_mark()) consider(t);
}

}  // namespace remodel
