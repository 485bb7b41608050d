#include "remodel/count_control.h"

#include <algorithm>

namespace remodel {

namespace {

double size_of(const Vertex& a, const Vertex& b, const Vertex& c, double h) {
  const double area = 0.5 * cross(b.point - a.point, c.point - a.point);
  const auto part = [area, h](const Vertex& v) { return area / (v.length_scale * v.length_scale * h * h); };
  return (part(a) + part(b) + part(c)) * (1.0 / 3.0);
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

// Vertices as they were when the journal had `from` entries of them.
class VerticesBefore {
 public:
  VerticesBefore(MeshData& mesh, std::size_t from)
      : mesh_(mesh), earlier_(mesh.triangulation.earlier_vertices()) {
    mesh.vertex_marks.clear(mesh.triangulation.vertex_slots());
    mesh.numbers.resize(std::max(mesh.numbers.size(), mesh.triangulation.vertex_slots()));
    for (std::size_t i = from; i < earlier_.size(); ++i)
      if (mesh.vertex_marks.visit(earlier_[i].id.index))
        mesh.numbers[earlier_[i].id.index] = static_cast<std::uint32_t>(i);
  }
  const Vertex& operator[](VertexId v) const {
    return mesh_.vertex_marks.visited(v.index) ? earlier_[mesh_.numbers[v.index]].vertex
                                               : mesh_.triangulation[v];
  }

 private:
  const MeshData& mesh_;
  std::span<const Triangulation::VertexBefore> earlier_;
};

constexpr std::size_t ahead = 8;  // in lists whose triangles and vertices are fetched before their turn

void prefetch_vertices(const MeshData& mesh, const Triangle& t) {
  for (const VertexId v : t.vertex)
    if (t.alive()) mesh.triangulation.prefetch(v);
}

// The size of the journal's triangles [from, end) as they were when it had `vertices` entries of vertices.
double size_before(MeshData& mesh, std::size_t from, std::size_t end, std::size_t vertices) {
  if (from == end) return 0.0;
  const VerticesBefore before(mesh, vertices);
  const auto earlier = mesh.triangulation.earlier();
  double sum = 0.0;
  for (std::size_t i = from; i < end; ++i) {
    if (i + ahead < end) prefetch_vertices(mesh, earlier[i + ahead].triangle);
    const Triangle& t = earlier[i].triangle;
    if (!t.alive() || t.region != Region::domain) continue;
    const Vertex &a = before[t.vertex[0]], &b = before[t.vertex[1]], &c = before[t.vertex[2]];
    if (is_interior(a, b, c)) sum += size_of(a, b, c, mesh.options.max_gradation);
  }
  return sum;
}

double touched_size(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  const auto touched = triangulation.touched();
  double sum = 0.0;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (i + 2 * ahead < touched.size()) triangulation.prefetch(touched[i + 2 * ahead]);
    if (i + ahead < touched.size()) prefetch_vertices(mesh, triangulation[touched[i + ahead]]);
    sum += interior_size_of(mesh, triangulation[touched[i]]);
  }
  return sum;
}

}  // namespace

double interior_size(const MeshData& mesh) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < mesh.triangulation.triangle_slots(); ++i)
    sum += interior_size_of(mesh, mesh.triangulation[TriangleId{i}]);
  return sum;
}

void know_interior_size(MeshData& mesh) {
  if (mesh.renewal.interior_size < 0.0) mesh.renewal.interior_size = interior_size(mesh);
}

double total_size(MeshData& mesh) {
  return mesh.renewal.interior_size + boundary_size(mesh);
}

double triangles_per_size(MeshData& mesh) {
  return static_cast<double>(mesh.domain_triangles) / total_size(mesh);
}

double free_area(const MeshData& mesh, VertexId v) {
  const Triangulation& triangulation = mesh.triangulation;
  if (triangulation[v].boundary != no_index) return 0.0;
  const Point p = triangulation.point(v);
  double twice = 0.0;
  triangulation.for_each_corner(v, [&](Corner c) {
    const Vertex &a = triangulation[triangulation.following(c)],
                 &b = triangulation[triangulation.preceding(c)];
    if (a.boundary != no_index || b.boundary != no_index || triangulation.is_touched(c.triangle)) return;
    twice += cross(a.point - p, b.point - p);
  });
  return 0.5 * twice;
}

double corrected_interior_size(MeshData& mesh, double before, const std::optional<RenewedSize>& renewed) {
  const std::size_t end = mesh.triangulation.earlier().size(), middle = renewed ? renewed->triangles : end;
  double sum = before - size_before(mesh, 0, middle, 0);
  if (renewed) sum += renewed->change - size_before(mesh, middle, end, renewed->vertices);
  return std::max(0.0, sum + touched_size(mesh));  // a negative one would count as unknown
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
