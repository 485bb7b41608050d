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
Mesh::Mesh(const Mesh& other) : data_(std::make_unique<MeshData>(other.data())) {}
Mesh& Mesh::operator=(const Mesh& other) {
  if (this != &other) data_ = std::make_unique<MeshData>(other.data());
  return *this;
}

// A mesh that was moved from has no data until it is changed.
MeshData& Mesh::data() {
  if (data_ == nullptr) data_ = std::make_unique<MeshData>();
  return *data_;
}
const MeshData& Mesh::data() const {
  static const MeshData none;
  return data_ == nullptr ? none : *data_;
}

bool Mesh::empty() const {
  return data().loop_heads.empty();
}
const Domain& Mesh::domain() const {
  return data().domain;
}
const QualityOptions& Mesh::options() const {
  return data().options;
}
std::uint32_t Mesh::step() const {
  return data().step;
}
std::size_t Mesh::triangle_count() const {
  return data().domain_triangles;
}

double Mesh::keep() const {
  return data().keep;
}
bool Mesh::held() const {
  return data().reference != nullptr;
}
double Mesh::delaunay_slack_deg() const {
  return held() ? data().delaunay_slack_deg : 0.0;
}
double Mesh::promised_gradation() const {
  return data().keep * data().options.max_gradation;
}

bool Mesh::imported() const {
  return !data().imported.empty();
}

bool Mesh::shows_file_triangles() const {
  return !data().imported.slots.empty();
}

Mark Mesh::mark() {
  return data().marked.mark(data().triangulation);
}

Changes Mesh::changes_since(const Mark& mark) const {
  return changes_in(data().triangulation, data().marked.of(mark));
}

MeshStatistics Mesh::statistics() const {
  const Triangulation& triangulation = data().triangulation;
  MeshStatistics result;
  double radius_edge = 0.0, held_radius_edge = 0.0, gradation = 0.0;  // squared
  const SmallAngles small_angles(data());
  const QualityBounds bounds = data().promised_bounds();
  std::vector<bool> used(triangulation.vertex_slots(), false);
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
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
      return;
    }
    held_radius_edge = std::max(held_radius_edge, r2 / shortest);
    gradation = std::max(gradation, r2 / (scale * scale));
  });
  result.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  for (const std::uint32_t head : data().loop_heads)
    data().walk(head,
                [&](std::uint32_t k) { result.steiner_boundary_vertices += data().at(k).steiner ? 1 : 0; });
  result.max_radius_edge = std::sqrt(radius_edge);
  result.max_gradation = std::sqrt(gradation) / promised_gradation();
  result.min_angle_deg = angle_of(radius_edge);
  result.min_held_angle_deg = angle_of(held_radius_edge);
  return result;
}

}  // namespace remodel
