#include "remodel/displacement.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "remodel/error.h"
#include "step/wall_field.h"

namespace remodel {

// What the field is of, whatever the mesh: places in the order of the frozen view, and which of them are on
// boundaries. The field's vertices are slots of a living mesh, or indices of points.
struct InteriorDisplacement::Impl {
  WallField field;
  std::vector<Point> places;
  std::vector<bool> on_boundary;
  std::vector<std::uint32_t> positions;  // of the field's vertices, in that order

  explicit Impl(WallField of) : field(std::move(of)) {}

  void add(std::uint32_t vertex, Point place, bool boundary) {
    positions[vertex] = static_cast<std::uint32_t>(places.size());
    places.push_back(place);
    on_boundary.push_back(boundary);
  }
  void require_size(std::size_t size) const {
    if (size != places.size())
      throw Error(ErrorCode::argument, "displacement",
                  "found " + std::to_string(size) + " values, expected one for each of " +
                      std::to_string(places.size()) + " points");
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

// The edges of a boundary, in rows that follow one another: a closed wall, or one that ends elsewhere.
void add_runs(const FrozenMesh& mesh, const FrozenBoundary& boundary, bool moving,
              std::vector<WallField::Run>& runs) {
  std::vector<std::uint32_t> leaves(mesh.points.size(), no_index);  // per point: the edge that begins there
  std::vector<bool> enters(mesh.points.size(), false), done(boundary.edges.size(), false);
  for (std::uint32_t i = 0; i < boundary.edges.size(); ++i) {
    const auto [a, b] = boundary.edges[i];
    if (leaves[a] == no_index) leaves[a] = i;
    enters[b] = true;
  }
  const auto follow = [&](std::uint32_t i) {
    WallField::Run run{{}, moving};
    while (i != no_index && !done[i]) {
      done[i] = true;
      const auto [a, b] = boundary.edges[i];
      const Point from = mesh.points[a], to = mesh.points[b];
      run.edges.push_back({VertexId{a}, VertexId{b}, from, to, std::sqrt(squared_distance(from, to))});
      i = leaves[b];
    }
    if (!run.edges.empty()) runs.push_back(std::move(run));
  };
  for (std::uint32_t i = 0; i < boundary.edges.size(); ++i)
    if (!enters[boundary.edges[i][0]]) follow(i);
  for (std::uint32_t i = 0; i < boundary.edges.size(); ++i) follow(i);
}

std::vector<WallField::Run> runs_of(const FrozenMesh& mesh, std::span<const std::string> moving) {
  for (const std::string& name : moving)
    if (std::ranges::none_of(mesh.boundaries, [&](const FrozenBoundary& b) { return b.name == name; }))
      throw Error(ErrorCode::argument, "moving", "found '" + name + "', expected names of boundaries");
  std::vector<WallField::Run> runs;
  for (const FrozenBoundary& boundary : mesh.boundaries)
    add_runs(mesh, boundary, std::ranges::find(moving, boundary.name) != moving.end(), runs);
  return runs;
}

}  // namespace

InteriorDisplacement::InteriorDisplacement(const Mesh& mesh, std::span<const std::size_t> moving) {
  const MeshData& data = with_loops(mesh, moving);
  const Triangulation& triangulation = data.triangulation;
  const std::span<const Point> held =
      data.reference ? std::span(data.reference->points) : std::span<const Point>();
  impl_ = std::make_unique<Impl>(WallField(data, moving, held));
  std::vector<bool> used(triangulation.vertex_slots(), false);
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    for (const VertexId v : t.vertex) used[v.index] = true;
  });
  impl_->positions.assign(used.size(), no_index);
  for (std::uint32_t i = 0; i < used.size(); ++i)
    if (used[i])
      impl_->add(i, held.empty() ? triangulation.point(VertexId{i}) : held[i],
                 triangulation[VertexId{i}].boundary != no_index);
}

InteriorDisplacement::InteriorDisplacement(const FrozenMesh& mesh, std::span<const std::string> moving)
    : impl_(std::make_unique<Impl>(WallField(runs_of(mesh, moving)))) {
  std::vector<bool> on_boundary(mesh.points.size(), false);
  for (const FrozenBoundary& boundary : mesh.boundaries)
    for (const auto& [a, b] : boundary.edges) on_boundary[a] = on_boundary[b] = true;
  impl_->positions.assign(mesh.points.size(), no_index);
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) impl_->add(i, mesh.points[i], on_boundary[i]);
}

InteriorDisplacement::~InteriorDisplacement() = default;
InteriorDisplacement::InteriorDisplacement(InteriorDisplacement&&) noexcept = default;
InteriorDisplacement& InteriorDisplacement::operator=(InteriorDisplacement&&) noexcept = default;

std::size_t InteriorDisplacement::points() const {
  return impl_->places.size();
}

std::vector<Point> InteriorDisplacement::jvp(std::span<const Point> walls) const {
  impl_->require_size(walls.size());
  WallField field = impl_->field;
  field.displace([&](VertexId v) {
    const std::uint32_t position = impl_->positions[v.index];
    return position == no_index ? Point{} : walls[position];
  });
  std::vector<Point> result(walls.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = impl_->on_boundary[i] ? walls[i] : field.at(impl_->places[i]);
  return result;
}

std::vector<Point> InteriorDisplacement::vjp(std::span<const Point> by_points) const {
  impl_->require_size(by_points.size());
  WallField field = impl_->field;
  std::vector<Point> result(by_points.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (impl_->on_boundary[i])
      result[i] = by_points[i];
    else
      field.pull(impl_->places[i], by_points[i]);
  }
  field.scatter([&](VertexId v, Point derivative) {
    const std::uint32_t position = impl_->positions[v.index];
    if (position != no_index) result[position] = result[position] + derivative;
  });
  return result;
}

}  // namespace remodel
