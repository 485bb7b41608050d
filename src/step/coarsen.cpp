#include "step/coarsen.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/renew_policy.h"

namespace remodel {

namespace {

class Coarsening {
 public:
  explicit Coarsening(MeshData& mesh)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        bounds_(QualityBounds::of_refinement(mesh.options)),
        candidates_(&mesh.arena) {}

  std::size_t touched(std::span<const VertexId> around, std::size_t budget) {
    forget_candidates();
    for (const TriangleId t : triangulation_.touched()) add_vertices(t);
    for (const VertexId v : around)
      triangulation_.for_each_corner(v, [&](Corner c) { add_vertices(c.triangle); });
    return remove_candidates(budget);
  }

  void everywhere_below(double bound) {
    forget_candidates();
    for (std::uint32_t i = 0; i < triangulation_.triangle_slots(); ++i) add_vertices(TriangleId{i});
    List<VertexId> going(&mesh_.arena);
    for (const auto& [ratio, v] : candidates_)
      if (ratio < bound) going.push_back(v);
    triangulation_.remove(going);
  }

  bool dissolve_below(double bound) {
    List<std::uint32_t> going(&mesh_.arena);
    for (const std::uint32_t head : mesh_.loop_heads)
      mesh_.walk(head, [&](std::uint32_t k) {
        if (mesh_.at(k).steiner && mesh_.at(k).twin == k && is_dense(mesh_.at(k).vertex, bound))
          going.push_back(k);
      });
    bool any = false;
    for (const std::uint32_t k : going) {
      if (!triangulation_.unsplit(mesh_.at(k).vertex)) continue;
      mesh_.remove_boundary_vertex(k);
      any = true;
    }
    return any;
  }

 private:
  bool is_dense(VertexId v, double bound) const {
    return triangulation_.any_corner(v, [&](Corner c) {
      const Triangle& triangle = triangulation_[c.triangle];
      return triangle.in_domain() && squared_ratio(triangle) < bound;
    });
  }

  std::size_t remove_candidates(std::size_t budget) {
    std::size_t removed = 0;
    std::sort(candidates_.begin(), candidates_.end());
    for (const auto& [ratio, v] : candidates_) {
      if (removed == budget) break;
      if (!can_go(v)) continue;
      triangulation_.remove(v);
      ++removed;
    }
    return removed;
  }

  // Candidates are the interior vertices of triangles that are much smaller than they may be, those of the
  // smallest first; ids break ties.
  void forget_candidates() {
    candidates_.clear();
    mesh_.seen_triangles.clear(triangulation_.triangle_slots());
    mesh_.candidate_indices.clear(triangulation_.vertex_slots());
  }

  void add_vertices(TriangleId t) {
    const Triangle& triangle = triangulation_[t];
    if (!triangle.in_domain() || !mesh_.seen_triangles.insert(t)) return;
    const double ratio = squared_ratio(triangle);
    if (ratio > RenewPolicy::coarsened_below) return;
    for (const VertexId v : triangle.vertex) {
      if (triangulation_[v].boundary != no_index) continue;
      const auto next = static_cast<std::uint32_t>(candidates_.size());
      if (mesh_.candidate_indices.insert(v, next)) candidates_.emplace_back(ratio, v);
      double& least = candidates_[mesh_.candidate_indices[v]].first;
      least = std::min(least, ratio);
    }
  }

  // (r / (H mean LS))^2
  double squared_ratio(const Triangle& t) const {
    double mean = 0.0;
    for (const VertexId v : t.vertex) mean += triangulation_[v].length_scale * (1.0 / 3.0);
    return t.circle.squared_radius() / (bounds_.squared_gradation * mean * mean);
  }

  bool can_go(VertexId v) const {
    return triangulation_.plan_removal(v, [this](const Triangulation::Ear& ear) { return is_fine(ear); });
  }

  bool is_fine(const Triangulation::Ear& ear) const {
    const Vertex &a = triangulation_[ear.vertex[0]], &b = triangulation_[ear.vertex[1]],
                 &c = triangulation_[ear.vertex[2]];
    if (!ear.circle.certain() || !is_good(a, b, c, ear.circle.squared_radius(), bounds_)) return false;
    for (int i = 0; i < 3; ++i) {
      const VertexId apex = ear.vertex[i], from = ear.vertex[next3(i)], to = ear.vertex[previous3(i)];
      if (encroaches(triangulation_.point(apex), triangulation_.point(from), triangulation_.point(to)) &&
          mesh_.edge_between(from, to) != no_index)
        return false;
    }
    return true;
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  QualityBounds bounds_;
  List<std::pair<double, VertexId>> candidates_;
};

}  // namespace

std::size_t coarsen_touched(MeshData& mesh, std::span<const VertexId> around, std::size_t budget) {
  return budget == 0 ? 0 : Coarsening(mesh).touched(around, budget);
}

void remove_dense(MeshData& mesh, double bound) {
  Coarsening(mesh).everywhere_below(bound);
}

bool dissolve_dense(MeshData& mesh, double bound) {
  return Coarsening(mesh).dissolve_below(bound);
}

}  // namespace remodel
