#include "step/count_control.h"

#include "mesh/renew_policy.h"

namespace remodel {

double size_of(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  double sum = 0.0;
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    const Vertex &a = triangulation[t.vertex[0]], &b = triangulation[t.vertex[1]],
                 &c = triangulation[t.vertex[2]];
    const double area = 0.5 * cross(b.point - a.point, c.point - a.point);
    const auto inverse_square = [](const Vertex& v) { return 1.0 / (v.length_scale * v.length_scale); };
    sum += area * (inverse_square(a) + inverse_square(b) + inverse_square(c));
  });
  const double h = mesh.options.max_gradation;
  return sum / (3.0 * h * h);
}

double triangles_per_size(const MeshData& mesh) {
  return static_cast<double>(mesh.domain_triangles) / size_of(mesh);
}

GenerateResult fresh_sample(const MeshData& like, double h_factor, StepObserver* observer) {
  QualityOptions options = like.options;
  options.max_gradation *= h_factor;
  GenerateResult fresh = generate(like.domain, options, observer);
  MeshData& data = fresh.mesh.data();
  data.options = like.options;
  data.keep = like.keep;
  return fresh;
}

double measured_count_factor(const MeshData& mesh, int samples, StepObserver* observer) {
  double sum = 0.0;
  int finished = 0;
  for (int i = 0; i < samples; ++i) {
    const double h_factor = 1.0 - RenewPolicy::sample_spread * i / samples;
    const GenerateResult fresh = fresh_sample(mesh, h_factor, observer);
    if (fresh.stopped != Stopped::done) continue;
    sum += triangles_per_size(fresh.mesh.data()) * h_factor * h_factor;
    ++finished;
  }
  return finished == 0 ? 0.0 : sum / finished;
}

}  // namespace remodel
