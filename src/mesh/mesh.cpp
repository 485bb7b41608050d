#include "remodel/mesh.h"

#include <algorithm>
#include <cmath>

#include "mesh/mesh_data.h"
#include "mesh/small_angles.h"

namespace remodel {

Mesh::Mesh() : data_(std::make_unique<MeshData>()) {}
Mesh::~Mesh() = default;
Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;
Mesh::Mesh(const Mesh& other) : data_(std::make_unique<MeshData>(*other.data_)) {}
Mesh& Mesh::operator=(const Mesh& other) {
  if (this != &other) data_ = std::make_unique<MeshData>(*other.data_);
  return *this;
}

const Domain& Mesh::domain() const {
  return data_->domain;
}
const QualityOptions& Mesh::options() const {
  return data_->options;
}
std::uint32_t Mesh::step() const {
  return data_->step;
}
std::size_t Mesh::triangle_count() const {
  return data_->domain_triangles;
}

bool Mesh::imported() const {
  return !data_->imported.empty();
}

bool Mesh::shows_file_triangles() const {
  return !data_->imported.slots.empty();
}

MeshStatistics Mesh::statistics() const {
  const Triangulation& triangulation = data_->triangulation;
  MeshStatistics result;
  double radius_edge = 0.0, held_radius_edge = 0.0, gradation = 0.0;  // squared
  const SmallAngles small_angles(*data_);
  const QualityBounds bounds(data_->options);
  std::vector<bool> used(triangulation.vertex_slots(), false);
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (!t.alive() || t.region != Region::domain) continue;
    ++result.triangles;
    double scale = 0.0;
    for (const VertexId v : t.vertex) {
      used[v.index] = true;
      scale += triangulation[v].length_scale / 3.0;
    }
    const auto [r2, shortest] = measure(triangulation, t);
    radius_edge = std::max(radius_edge, r2 / shortest);
    if (badness(triangulation, t, bounds) > 1.0 && small_angles.exempt(t)) {
      ++result.exempt_triangles;
      continue;
    }
    held_radius_edge = std::max(held_radius_edge, r2 / shortest);
    gradation = std::max(gradation, r2 / (scale * scale));
  }
  result.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  for (const std::uint32_t head : data_->loop_heads)
    data_->walk(head,
                [&](std::uint32_t k) { result.steiner_boundary_vertices += data_->at(k).steiner ? 1 : 0; });
  result.max_radius_edge = std::sqrt(radius_edge);
  result.max_gradation = std::sqrt(gradation) / promised_gradation(data_->options);
  result.min_angle_deg = angle_of(radius_edge);
  result.min_held_angle_deg = angle_of(held_radius_edge);
  return result;
}

}  // namespace remodel
