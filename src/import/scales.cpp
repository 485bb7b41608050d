#include "import/scales.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace remodel {

namespace {

// How much larger than the triangles' own sizes length scales are. With 1, triangles of the sizes of their
// neighbours would be at the bound, and what is refined comes out smaller than what it replaces; with 2, new
// layers of triangles at a wall may be twice as high as the old ones. Measured on four meshes of two
// programs, whole airfoils replaced by others: new triangles over lost ones are 1.2 to 1.9 with 1, 1.1 to 1.6
// with 1.5, 1.0 to 1.4 with 2. A mesh that generate() makes has 1.25 (G from 4 to 8) and more.
constexpr double scale_factor = 1.5;

std::vector<double> mean_scales(const Triangulation& triangulation, double inverse_h) {
  std::vector<double> sum(triangulation.vertex_slots(), 0.0), count(triangulation.vertex_slots(), 0.0);
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    const double scale = scale_factor * std::sqrt(t.circle.squared_radius()) * inverse_h;
    for (const VertexId v : t.vertex) sum[v.index] += scale, count[v.index] += 1.0;
  });
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0.0) sum[i] /= count[i];
  return sum;
}

using Vertices = std::array<VertexId, 3>;

double squared_radius(const Triangulation& triangulation, const Vertices& t) {
  return certified_circle(triangulation.point(t[0]), triangulation.point(t[1]), triangulation.point(t[2]))
      .squared_radius();
}

// The triangles of the living mesh, and those of the file that are shown in their place.
template <class Visit>
void for_each_triangle_shown(const MeshData& mesh, Visit visit) {
  mesh.triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    visit(Vertices{t.vertex[0], t.vertex[1], t.vertex[2]});
  });
  const std::vector<std::uint32_t>& file = mesh.imported.triangles;
  for (std::size_t i = 0; i < file.size(); i += 3)
    visit(Vertices{VertexId{file[i]}, VertexId{file[i + 1]}, VertexId{file[i + 2]}});
}

// Raising never makes another triangle bad, so that one pass is enough.
void raise_where_too_small(const MeshData& mesh, double inverse_h, std::vector<double>& scales) {
  constexpr double margin = 1.0 + 1e-8;  // that of QualityBounds and rounding
  for_each_triangle_shown(mesh, [&](const Vertices& t) {
    const double wanted = margin * std::sqrt(squared_radius(mesh.triangulation, t)) * inverse_h;
    double mean = 0.0;
    for (const VertexId v : t) mean += scales[v.index] / 3.0;
    if (mean >= wanted) return;
    for (const VertexId v : t) scales[v.index] *= margin * wanted / mean;
  });
}

}  // namespace

double worst_squared_radius_edge(const MeshData& mesh) {
  double worst = 0.0;
  for_each_triangle_shown(mesh, [&](const Vertices& t) {
    double shortest = INFINITY;
    for (std::size_t k = 0; k < 3; ++k)
      shortest = std::min(shortest, squared_distance(mesh.triangulation.point(t[k]),
                                                     mesh.triangulation.point(t[(k + 1) % 3])));
    worst = std::max(worst, squared_radius(mesh.triangulation, t) / shortest);
  });
  return worst;
}

void set_length_scales(MeshData& mesh) {
  const double inverse_h = 1.0 / mesh.options.max_gradation;
  std::vector<double> scales = mean_scales(mesh.triangulation, inverse_h);
  raise_where_too_small(mesh, inverse_h, scales);
  for (std::uint32_t i = 1; i < scales.size(); ++i)
    mesh.triangulation.set_length_scale(VertexId{i}, scales[i]);
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k)
    mesh.set_boundary_length_scale(k, scales[mesh.at(k).vertex.index]);
}

double measured_gradation(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  std::vector<double> slopes;
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    for (int k = 0; k < 3; ++k) {
      const Vertex &a = triangulation[t.vertex[k]], &b = triangulation[t.vertex[next3(k)]];
      slopes.push_back(std::abs(a.length_scale - b.length_scale) /
                       std::sqrt(squared_distance(a.point, b.point)));
    }
  });
  const auto ninth = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() * 9 / 10);
  std::nth_element(slopes.begin(), ninth, slopes.end());
  return std::clamp(1.0 / *ninth, 0.1, 100.0);
}

}  // namespace remodel
