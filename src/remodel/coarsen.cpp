#include "remodel/coarsen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace remodel {

namespace {

class Coarsening {
 public:
  explicit Coarsening(MeshData& mesh)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        bounds_(QualityBounds::of_refinement(mesh.options)) {}

  std::size_t run(std::size_t budget) {
    std::size_t removed = 0;
    for (const auto& [density, v] : candidates()) {
      if (removed == budget) break;
      if (!can_go(v)) continue;
      triangulation_.remove(v);
      ++removed;
    }
    return removed;
  }

 private:
  // Squared distance to the nearest neighbour over squared length scale, ascending; ids break ties.
  std::vector<std::pair<double, VertexId>> candidates() {
    std::vector<std::pair<double, VertexId>> found;
    mesh_.vertex_marks.clear(triangulation_.vertex_slots());
    for (const TriangleId t : triangulation_.touched()) {
      const Triangle& triangle = triangulation_[t];
      if (!triangle.alive() || triangle.region != Region::domain) continue;
      for (const VertexId v : triangle.vertex)
        if (triangulation_[v].boundary == no_index && mesh_.vertex_marks.visit(v.index))
          found.emplace_back(density(v), v);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  double density(VertexId v) const {
    double nearest = std::numeric_limits<double>::infinity();
    const Vertex& vertex = triangulation_[v];
    const Corner first = triangulation_.star(v);
    Corner c = first;
    do {
      nearest = std::min(nearest, squared_distance(vertex.point, triangulation_.point(triangulation_.following(c))));
      c = triangulation_.counterclockwise(c);
    } while (c.triangle != first.triangle);
    return nearest / (vertex.length_scale * vertex.length_scale);
  }

  bool can_go(VertexId v) {
    return triangulation_.plan_removal(v, ears_) &&
           std::all_of(ears_.begin(), ears_.end(), [&](const Triangulation::Ear& ear) { return is_fine(ear); });
  }

  bool is_fine(const Triangulation::Ear& ear) const {
    const Vertex &a = triangulation_[ear.vertex[0]], &b = triangulation_[ear.vertex[1]],
                 &c = triangulation_[ear.vertex[2]];
    const Circle circle = certified_circle(a.point, b.point, c.point);
    if (!circle.certain() || !is_good(a, b, c, circle.squared_radius(), bounds_)) return false;
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
  std::vector<Triangulation::Ear> ears_;  // scratch
};

}  // namespace

std::size_t coarsen_touched(MeshData& mesh, std::size_t budget) {
  return budget == 0 ? 0 : Coarsening(mesh).run(budget);
}

}  // namespace remodel
