#include "remodel/count_control.h"

#include <algorithm>

namespace remodel {

namespace {

double size_of(const Vertex& a, const Vertex& b, const Vertex& c, double h) {
  const double area = 0.5 * cross(b.point - a.point, c.point - a.point);
  const double mean = (a.length_scale + b.length_scale + c.length_scale) * (1.0 / 3.0) * h;
  return area / (mean * mean);
}

bool is_interior(const Vertex& a, const Vertex& b, const Vertex& c) {
  return a.boundary == no_index && b.boundary == no_index && c.boundary == no_index;
}

double interior_size_of(const MeshData& mesh, const Triangle& t) {
  if (!t.alive() || t.region != Region::domain) return 0.0;
  const Triangulation& triangulation = mesh.triangulation;
  const Vertex &a = triangulation[t.vertex[0]], &b = triangulation[t.vertex[1]],
               &c = triangulation[t.vertex[2]];
  return is_interior(a, b, c) ? size_of(a, b, c, mesh.options.max_gradation) : 0.0;
}

// Vertices as they were when the journal began.
class VerticesBefore {
 public:
  explicit VerticesBefore(MeshData& mesh) : mesh_(mesh), earlier_(mesh.triangulation.earlier_vertices()) {
    mesh.vertex_marks.clear(mesh.triangulation.vertex_slots());
    mesh.numbers.resize(std::max(mesh.numbers.size(), mesh.triangulation.vertex_slots()));
    for (std::uint32_t i = 0; i < earlier_.size(); ++i)
      if (mesh.vertex_marks.visit(earlier_[i].id.index)) mesh.numbers[earlier_[i].id.index] = i;
  }
  const Vertex& operator[](VertexId v) const {
    return mesh_.vertex_marks.visited(v.index) ? earlier_[mesh_.numbers[v.index]].vertex
                                               : mesh_.triangulation[v];
  }
  // Those on boundaries are left out.
  template <class Visit>
  void for_each_with_another_scale(Visit visit) const {
    for (std::uint32_t i = 0; i < earlier_.size(); ++i) {
      const auto& [v, vertex] = earlier_[i];
      if (vertex.boundary != no_index || mesh_.numbers[v.index] != i) continue;
      const Vertex& now = mesh_.triangulation[v];
      if (now.alive() && now.length_scale != vertex.length_scale) visit(v);
    }
  }

 private:
  const MeshData& mesh_;
  std::span<const Triangulation::VertexBefore> earlier_;
};

}  // namespace

double interior_size(const MeshData& mesh) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < mesh.triangulation.triangle_slots(); ++i)
    sum += interior_size_of(mesh, mesh.triangulation[TriangleId{i}]);
  return sum;
}

double triangles_per_size(MeshData& mesh) {
  return static_cast<double>(mesh.domain_triangles) / (mesh.renewal.interior_size + boundary_size(mesh));
}

double corrected_interior_size(MeshData& mesh, double before) {
  const Triangulation& triangulation = mesh.triangulation;
  const VerticesBefore vertices(mesh);
  double sum = before;
  const auto subtract = [&](const Triangle& t) {
    if (!t.alive() || t.region != Region::domain) return;
    const Vertex &a = vertices[t.vertex[0]], &b = vertices[t.vertex[1]], &c = vertices[t.vertex[2]];
    if (is_interior(a, b, c)) sum -= size_of(a, b, c, mesh.options.max_gradation);
  };
  constexpr std::size_t look_ahead = 8;
  const auto prefetch_vertices = [&](const Triangle& t) {
    for (const VertexId v : t.vertex)
      if (t.alive()) triangulation.prefetch(v);
  };
  const auto earlier = triangulation.earlier();
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    if (i + look_ahead < earlier.size()) prefetch_vertices(earlier[i + look_ahead].triangle);
    subtract(earlier[i].triangle);
  }
  const auto touched = triangulation.touched();
  mesh.marks.clear(triangulation.triangle_slots());
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (i + 2 * look_ahead < touched.size()) triangulation.prefetch(touched[i + 2 * look_ahead]);
    if (i + look_ahead < touched.size()) prefetch_vertices(triangulation[touched[i + look_ahead]]);
    sum += interior_size_of(mesh, triangulation[touched[i]]);
    mesh.marks.visit(touched[i].index);
  }
  // Triangles that are as they were, at vertices whose length scale is not.
  vertices.for_each_with_another_scale([&](VertexId v) {
    triangulation.for_each_corner(v, [&](Corner c) {
      if (!mesh.marks.visit(c.triangle.index)) return;
      subtract(triangulation[c.triangle]);
      sum += interior_size_of(mesh, triangulation[c.triangle]);
    });
  });
  return sum;
}

double boundary_size(MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  double sum = 0.0;
  mesh.marks.clear(triangulation.triangle_slots());
  for (const std::uint32_t head : mesh.loop_heads)
    mesh.walk(head, [&](std::uint32_t k) {
      triangulation.for_each_corner(mesh.at(k).vertex, [&](Corner c) {
        const Triangle& t = triangulation[c.triangle];
        if (t.region == Region::domain && mesh.marks.visit(c.triangle.index))
          sum += size_of(triangulation[t.vertex[0]], triangulation[t.vertex[1]], triangulation[t.vertex[2]],
                         mesh.options.max_gradation);
      });
    });
  return sum;
}

GenerateResult fresh_sample(const MeshData& like, double h_factor, StepObserver* observer) {
  QualityOptions options = like.options;
  options.max_gradation *= h_factor;
  GenerateResult fresh = generate(like.domain, options, observer);
  fresh.mesh.data().options = like.options;
  fresh.mesh.data().renewal.interior_size = interior_size(fresh.mesh.data());
  return fresh;
}

double measured_count_factor(const MeshData& mesh, int samples, StepObserver* observer) {
  double sum = 0.0;
  int finished = 0;
  for (int i = 0; i < samples; ++i) {
    const double h_factor = 1.0 - 0.005 * i / samples;
    GenerateResult fresh = fresh_sample(mesh, h_factor, observer);
    if (fresh.stopped != Stopped::done) continue;
    sum += triangles_per_size(fresh.mesh.data()) * h_factor * h_factor;
    ++finished;
  }
  return finished == 0 ? 0.0 : sum / finished;
}

}  // namespace remodel
