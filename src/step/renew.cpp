#include "step/renew.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "mesh/renew_policy.h"

namespace remodel {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tolerance = RenewPolicy::length_scale_tolerance;

// Vertices in ascending order of a length scale; ids break ties.
using Entry = std::pair<double, VertexId>;
using Heap = std::priority_queue<Entry, List<Entry>, std::greater<>>;

bool is_given(const MeshData& mesh, VertexId v) {
  const std::uint32_t k = mesh.triangulation[v].boundary;
  return k != no_index && !mesh.at(k).steiner;
}

// An upper bound from the curves, for Steiner vertices on them.
double interpolation(const MeshData& mesh, VertexId v) {
  const std::uint32_t k = mesh.triangulation[v].boundary;
  return k == no_index ? infinity : mesh.base_length_scale(k);
}

// Visits the neighbours of v along domain edges: visit(u, |uv| / G). Those on the boundary's own edges may
// come twice.
template <class Visit>
void for_each_neighbour(const MeshData& mesh, VertexId v, Visit visit) {
  const Triangulation& triangulation = mesh.triangulation;
  const Point p = triangulation.point(v);
  const double inverse_gradation = 1.0 / mesh.options.gradation;
  const auto visit_one = [&](VertexId u) {
    visit(u, std::sqrt(squared_distance(triangulation.point(u), p)) * inverse_gradation);
  };
  triangulation.for_each_corner(v, [&](Corner c) {
    if (triangulation[c.triangle].region != Region::domain) return;
    visit_one(triangulation.following(c));
    // Otherwise the next triangle's.
    if (triangulation.link({c.triangle, next3(c.index)}).constrained()) visit_one(triangulation.preceding(c));
  });
}

class Renewal {
 public:
  explicit Renewal(MeshData& mesh)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        suspects_(std::greater<>(), List<Entry>(&mesh.arena)),
        falling_(std::greater<>(), List<Entry>(&mesh.arena)),
        waiting_(&mesh.arena),
        higher_(&mesh.arena),
        changes_(&mesh.arena),
        risen_(&mesh.arena) {}

  List<VertexId> run(std::span<const std::uint32_t> loops, std::span<const std::uint32_t> vertices) {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    for (const std::uint32_t loop : loops)
      mesh_.walk(mesh_.loop_heads[loop], [&](std::uint32_t k) { add_around(mesh_.at(k).vertex); });
    for (const TriangleId t : triangulation_.touched())
      if (triangulation_[t].alive()) add_vertices(t);
    for (const std::uint32_t v : vertices)
      if (triangulation_[VertexId{v}].alive()) add(VertexId{v});
    raise();
    spread();
    keep_small_changes();
    return std::move(risen_);
  }

 private:
  double scale(VertexId v) const { return triangulation_[v].length_scale; }

  // ---- what is looked at first
  void add_around(VertexId v) {
    triangulation_.for_each_corner(v, [&](Corner c) { add_vertices(c.triangle); });
  }
  void add_vertices(TriangleId t) {
    if (triangulation_[t].region != Region::domain) return;
    for (const VertexId v : triangulation_[t].vertex) add(v);
  }
  void add(VertexId v) {
    if (mesh_.seen_vertices.insert(v) && !is_given(mesh_, v)) suspect_unless_fine(v);
  }
  void suspect_unless_fine(VertexId v) {
    if (std::abs(support(v) - scale(v)) > tolerance * scale(v)) suspects_.push({scale(v), v});
  }

  // F(v) by the present length scales.
  double support(VertexId v) const {
    double least = interpolation(mesh_, v);
    for_each_neighbour(mesh_, v, [&](VertexId u, double step) { least = std::min(least, scale(u) + step); });
    return least;
  }

  // ---- phase 1: in ascending order, so that all that lies lower is final but for what phase 2 lowers. What
  // nothing lower accounts for rises; it never waits for vertices that may have their length scale from it.
  void raise() {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());  // of those that rose
    VertexId last;
    while (!suspects_.empty()) {
      const auto [old, v] = suspects_.top();
      suspects_.pop();
      if (v == last) continue;
      last = v;
      look_at(v, old);
    }
    for (const VertexId v : waiting_) falling_.push({support(v), v});
  }

  bool rose(VertexId v) const { return mesh_.seen_vertices.contains(v); }

  void look_at(VertexId v, double old) {
    double found = interpolation(mesh_, v), undecided = infinity;
    higher_.clear();
    for_each_neighbour(mesh_, v, [&](VertexId u, double step) {
      const double theirs = scale(u);
      const bool decided = theirs < old || rose(u);
      (decided ? found : undecided) = std::min(decided ? found : undecided, theirs + step);
      if (theirs > old && !decided) higher_.push_back(u);
    });
    if (found < old * (1.0 - tolerance)) falling_.push({found, v});
    if (found <= old * (1.0 + tolerance)) return;
    mesh_.seen_vertices.insert(v);
    change(v, found);
    if (undecided < found) waiting_.push_back(v);
    // All that lie higher, not only those that v accounts for: refinement sets length scales once, before
    // later vertices come between, so that some of them have nothing any more that accounts for them.
    for (const VertexId u : higher_)
      if (!is_given(mesh_, u)) suspects_.push({scale(u), u});
  }

  // ---- phase 2: Dijkstra's algorithm
  void spread() {
    while (!falling_.empty()) {
      const auto [found, v] = falling_.top();
      falling_.pop();
      if (!(found < scale(v) * (1.0 - tolerance)) || found == infinity) continue;
      change(v, found);
      for_each_neighbour(mesh_, v, [&, reached = found](VertexId u, double step) {
        if (reached + step < scale(u) * (1.0 - tolerance) && !is_given(mesh_, u))
          falling_.push({reached + step, u});
      });
    }
  }

  void change(VertexId v, double value) {
    changes_.push_back({v, scale(v)});
    triangulation_.set_length_scale(v, value);
  }

  // ---- what came back to about where it was did not change. Triangles at a vertex that fell may be bad now.
  void keep_small_changes() {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    for (const auto& [v, old] : changes_) {
      if (!mesh_.seen_vertices.insert(v)) continue;  // the first change has the length scale from before
      if (std::abs(scale(v) - old) <= tolerance * old) {
        triangulation_.set_length_scale(v, old);
        continue;
      }
      if (const std::uint32_t k = triangulation_[v].boundary; k != no_index)
        mesh_.set_boundary_length_scale(k, scale(v));
      if (scale(v) > old)
        risen_.push_back(v);
      else
        triangulation_.for_each_corner(v, [&](Corner c) {
          if (triangulation_[c.triangle].region == Region::domain) triangulation_.touch(c.triangle);
        });
    }
  }

  struct Change {
    VertexId vertex;
    double old;
  };

  MeshData& mesh_;
  Triangulation& triangulation_;
  Heap suspects_, falling_;
  List<VertexId> waiting_;  // rose, but may have risen too far: something undecided offered less
  List<VertexId> higher_;   // scratch
  List<Change> changes_;
  List<VertexId> risen_;
};

}  // namespace

List<VertexId> renew_length_scales(MeshData& mesh, std::span<const std::uint32_t> loops,
                                   std::span<const std::uint32_t> vertices) {
  return Renewal(mesh).run(loops, vertices);
}

std::vector<double> propagated_length_scales(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  std::vector<double> scales(triangulation.vertex_slots(), infinity);
  Heap heap;
  for (const std::uint32_t head : mesh.loop_heads)
    mesh.walk(head, [&](std::uint32_t k) {
      const VertexId v = mesh.at(k).vertex;
      heap.push({mesh.at(k).steiner ? interpolation(mesh, v) : mesh.length_scale(k), v});
    });
  while (!heap.empty()) {
    const auto [found, v] = heap.top();
    heap.pop();
    if (!(found < scales[v.index])) continue;
    scales[v.index] = found;
    for_each_neighbour(mesh, v, [&, reached = found](VertexId u, double step) {
      if (reached + step < scales[u.index] && !is_given(mesh, u)) heap.push({reached + step, u});
    });
  }
  for (std::uint32_t i = 0; i < scales.size(); ++i)
    if (scales[i] == infinity) scales[i] = triangulation[VertexId{i}].length_scale;
  return scales;
}

}  // namespace remodel
