#include "remodel/displacement.h"

#include <string>

#include "remodel/error.h"
#include "step/wall_field.h"

namespace remodel {

struct InteriorDisplacement::Impl {
  struct Vertex {
    VertexId id;
    Point point;
    bool boundary;
  };
  WallField field;
  std::vector<Vertex> vertices;            // as the frozen mesh has them: ascending
  std::vector<std::uint32_t> positions{};  // in that list, by slot

  Impl(const MeshData& mesh, std::span<const std::size_t> moving)
      : field(mesh, moving, mesh.reference ? std::span(mesh.reference->points) : std::span<const Point>()) {
    const Triangulation& triangulation = mesh.triangulation;
    const auto place = [&](std::uint32_t slot) {
      return mesh.reference ? mesh.reference->points[slot] : triangulation.point(VertexId{slot});
    };
    std::vector<bool> used(triangulation.vertex_slots(), false);
    triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
      for (const VertexId v : t.vertex) used[v.index] = true;
    });
    positions.assign(used.size(), no_index);
    for (std::uint32_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      positions[i] = static_cast<std::uint32_t>(vertices.size());
      const auto& vertex = triangulation[VertexId{i}];
      vertices.push_back({VertexId{i}, place(i), vertex.boundary != no_index});
    }
  }

  void require_size(std::size_t size) const {
    if (size != vertices.size())
      throw Error(ErrorCode::argument, "displacement",
                  "found " + std::to_string(size) + " values, expected one for each of " +
                      std::to_string(vertices.size()) + " points");
  }
};

namespace {

const MeshData& with_loops(const Mesh& mesh, std::span<const std::size_t> moving) {
  for (std::size_t i = 0; i < moving.size(); ++i)
    if (moving[i] >= mesh.domain().loops.size() || (i > 0 && moving[i] <= moving[i - 1]))
      throw Error(ErrorCode::argument, "moving",
                  "found loop " + std::to_string(moving[i]) + ", expected ascending indices below " +
                      std::to_string(mesh.domain().loops.size()));
  return mesh.data();
}

}  // namespace

InteriorDisplacement::InteriorDisplacement(const Mesh& mesh, std::span<const std::size_t> moving)
    : impl_(std::make_unique<Impl>(with_loops(mesh, moving), moving)) {}
InteriorDisplacement::~InteriorDisplacement() = default;
InteriorDisplacement::InteriorDisplacement(InteriorDisplacement&&) noexcept = default;
InteriorDisplacement& InteriorDisplacement::operator=(InteriorDisplacement&&) noexcept = default;

std::size_t InteriorDisplacement::points() const {
  return impl_->vertices.size();
}

std::vector<Point> InteriorDisplacement::jvp(std::span<const Point> walls) const {
  impl_->require_size(walls.size());
  WallField field = impl_->field;
  field.displace([&](VertexId v) {
    const std::uint32_t position = impl_->positions[v.index];
    return position == no_index ? Point{} : walls[position];
  });
  std::vector<Point> result(walls.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Impl::Vertex& vertex = impl_->vertices[i];
    result[i] = vertex.boundary ? walls[i] : field.at(vertex.point);
  }
  return result;
}

std::vector<Point> InteriorDisplacement::vjp(std::span<const Point> by_points) const {
  impl_->require_size(by_points.size());
  WallField field = impl_->field;
  std::vector<Point> result(by_points.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Impl::Vertex& vertex = impl_->vertices[i];
    if (vertex.boundary)
      result[i] = by_points[i];
    else
      field.pull(vertex.point, by_points[i]);
  }
  field.scatter([&](VertexId v, Point derivative) {
    const std::uint32_t position = impl_->positions[v.index];
    if (position != no_index) result[position] = result[position] + derivative;
  });
  return result;
}

}  // namespace remodel
