#include "remodel/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/import_record.h"
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
    double shortest = INFINITY, longest_product = 1.0, scale = 0.0;
    for (int k = 0; k < 3; ++k) {
      used[t.vertex[k].index] = true;
      const double l = squared_distance(triangulation.point(t.vertex[next3(k)]),
                                        triangulation.point(t.vertex[previous3(k)]));
      shortest = std::min(shortest, l);
      longest_product *= l;
      scale += triangulation[t.vertex[k]].length_scale / 3.0;
    }
    const Point a = triangulation.point(t.vertex[0]);
    const double twice_area =
        cross(triangulation.point(t.vertex[1]) - a, triangulation.point(t.vertex[2]) - a);
    const double r2 = longest_product / (4.0 * twice_area * twice_area);
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
  result.max_gradation = std::sqrt(gradation) / data_->options.max_gradation;
  const auto degrees = [](double squared_ratio) {
    return squared_ratio > 0.0 ? std::asin(0.5 / std::sqrt(squared_ratio)) * 180.0 / std::numbers::pi : 0.0;
  };
  result.min_angle_deg = degrees(radius_edge);
  result.min_held_angle_deg = degrees(held_radius_edge);
  return result;
}

namespace {

// Names in the order of the design's curves, each once.
std::size_t boundary_index(FrozenMesh& frozen, const std::string& name) {
  for (std::size_t i = 0; i < frozen.boundaries.size(); ++i)
    if (frozen.boundaries[i].name == name) return i;
  frozen.boundaries.push_back({name, {}});
  return frozen.boundaries.size() - 1;
}

// A vertex where chains join lies on several curves: the view names the one of its first entry.
void freeze_boundary(const MeshData& mesh, const std::vector<std::uint32_t>& point_of, FrozenMesh& frozen) {
  for (const std::string& marker : mesh.imported.markers) boundary_index(frozen, marker);
  for (std::size_t curve = 0; curve < mesh.domain.curve_count(); ++curve)
    boundary_index(frozen, mesh.domain.curve(curve).name);
  for (std::size_t loop = 0; loop < mesh.loop_heads.size(); ++loop) {
    struct Named {
      std::size_t boundary;
      std::array<std::uint32_t, 2> edge;
    };
    std::vector<Named> edges;  // along the loop
    mesh.walk_edges(mesh.loop_heads[loop], [&](std::uint32_t k, std::uint32_t next) {
      const BoundaryVertex& from = mesh.at(k);
      edges.push_back({boundary_index(frozen, mesh.curve(from.curve).name),
                       {point_of[from.vertex.index], point_of[mesh.at(next).vertex.index]}});
    });
    mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) {
      if (mesh.triangulation[mesh.at(k).vertex].boundary != k) return;
      const std::uint32_t p = point_of[mesh.at(k).vertex.index];
      frozen.curve[p] = static_cast<std::int32_t>(mesh.at(k).curve);
      frozen.parameter[p] = mesh.at(k).t;
    });
    if (mesh.sides[loop].left != Region::domain) {
      std::reverse(edges.begin(), edges.end());
      for (Named& named : edges) std::swap(named.edge[0], named.edge[1]);
    }
    for (const Named& named : edges) frozen.boundaries[named.boundary].edges.push_back(named.edge);
  }
}

}  // namespace

// Points in the order of vertex ids, triangles in the order of triangle ids.
FrozenMesh Mesh::freeze() const {
  const Triangulation& triangulation = data_->triangulation;
  FrozenMesh frozen;
  std::vector<std::uint32_t> point_of(triangulation.vertex_slots(), no_index);
  const auto as_imported = triangles_as_imported(*data_);
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (!t.alive() || t.region != Region::domain) continue;
    frozen.triangle_ids.push_back(i);
    frozen.birth.push_back(t.birth);
    const auto kept = as_imported.find(i);
    frozen.triangles.push_back(kept != as_imported.end()
                                   ? kept->second
                                   : std::array{t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
    for (const VertexId v : t.vertex) point_of[v.index] = 0;
  }
  for (std::uint32_t i = 0; i < triangulation.vertex_slots(); ++i) {
    if (point_of[i] == no_index) continue;
    point_of[i] = static_cast<std::uint32_t>(frozen.points.size());
    frozen.points.push_back(triangulation.point(VertexId{i}));
    frozen.length_scale.push_back(triangulation[VertexId{i}].length_scale);
    frozen.vertex_ids.push_back(i);
  }
  for (auto& triangle : frozen.triangles)
    for (std::uint32_t& v : triangle) v = point_of[v];
  frozen.curve.assign(frozen.points.size(), -1);
  frozen.parameter.assign(frozen.points.size(), 0.0);
  freeze_boundary(*data_, point_of, frozen);
  return frozen;
}

}  // namespace remodel
