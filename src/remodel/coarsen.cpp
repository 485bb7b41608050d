#include "remodel/coarsen.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace remodel {

namespace {

// A vertex's star loses two of about six triangles with it, and those that are left are larger by half. Where
// no triangle is smaller than this, squared, that is too much for the others.
constexpr double small = 0.4;

class Coarsening {
 public:
  explicit Coarsening(MeshData& mesh)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        bounds_(QualityBounds::of_refinement(mesh.options)),
        candidates_(&mesh.arena) {}

  std::size_t run(std::span<const VertexId> around, std::size_t budget) {
    std::size_t removed = 0;
    list_candidates(around);
    for (const auto& [ratio, v] : candidates_) {
      if (removed == budget) break;
      if (!can_go(v)) continue;
      triangulation_.remove(v);
      ++removed;
    }
    return removed;
  }

 private:
  // The interior vertices of triangles that are much smaller than they may be, those of the smallest first;
  // ids break ties. mesh.numbers holds a listed vertex' place in the list.
  void list_candidates(std::span<const VertexId> around) {
    mesh_.marks.clear(triangulation_.triangle_slots());
    mesh_.vertex_marks.clear(triangulation_.vertex_slots());
    mesh_.numbers.resize(std::max(mesh_.numbers.size(), triangulation_.vertex_slots()));
    for (const TriangleId t : triangulation_.touched()) add_vertices(t);
    for (const VertexId v : around)
      triangulation_.for_each_corner(v, [&](Corner c) { add_vertices(c.triangle); });
    std::sort(candidates_.begin(), candidates_.end());
  }

  void add_vertices(TriangleId t) {
    const Triangle& triangle = triangulation_[t];
    if (!triangle.alive() || triangle.region != Region::domain || !mesh_.marks.visit(t.index)) return;
    const double ratio = squared_ratio(triangle);
    if (ratio > small) return;
    for (const VertexId v : triangle.vertex) {
      if (triangulation_[v].boundary != no_index) continue;
      std::uint32_t& place = mesh_.numbers[v.index];
      if (mesh_.vertex_marks.visit(v.index)) {
        place = static_cast<std::uint32_t>(candidates_.size());
        candidates_.emplace_back(ratio, v);
      } else {
        candidates_[place].first = std::min(candidates_[place].first, ratio);
      }
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
    for (int i = 0; i < 3; ++i)
      if (encroaches(ear.vertex[i], ear.vertex[next3(i)], ear.vertex[previous3(i)])) return false;
    return true;
  }

  bool encroaches(VertexId apex, VertexId a, VertexId b) const {
    const Point p = triangulation_.point(apex);
    return dot(triangulation_.point(a) - p, triangulation_.point(b) - p) < 0.0 &&
           mesh_.edge_between(a, b) != no_index;
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  QualityBounds bounds_;
  List<std::pair<double, VertexId>> candidates_;
};

}  // namespace

std::size_t coarsen_touched(MeshData& mesh, std::span<const VertexId> around, std::size_t budget) {
  return budget == 0 ? 0 : Coarsening(mesh).run(around, budget);
}

}  // namespace remodel
