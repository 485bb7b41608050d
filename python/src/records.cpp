// The records of the library's public headers, as pickles have them.

#include "records.h"

namespace remodel {

template <python::Is<FrozenBoundary> T>
auto members(T& b) {
  return std::tie(b.name, b.edges);
}
template <python::Is<FrozenMesh> T>
auto members(T& m) {
  return std::tie(m.points, m.triangles, m.boundaries, m.length_scale, m.vertex_ids, m.triangle_ids, m.birth,
                  m.curve, m.parameter, m.vertex_keys, m.last_generation, m.steiner, m.region, m.region_names,
                  m.gradation_error, m.fate, m.delaunay_slack_deg, m.quads, m.layer_triangles, m.periodic);
}

namespace python {
namespace {

// What the rest of the library takes for granted of a frozen mesh: indices in range, one value a point or
// cell.
void require_sound(const FrozenMesh& mesh) {
  const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size(), cells = mesh.cell_count();
  const auto fits = [](const auto& values, std::size_t count) {
    require_pickle(values.empty() || values.size() == count, "one value a point or cell");
  };
  for (std::size_t i = 0; i < cells; ++i)
    for (const std::uint32_t v : mesh.cell(i)) require_pickle(v < points, "cells of points that there are");
  require_pickle(mesh.layer_triangles <= triangles, "no more triangles in layers than there are");
  for (const FrozenBoundary& boundary : mesh.boundaries)
    for (const auto& edge : boundary.edges)
      for (const std::uint32_t v : edge) require_pickle(v < points, "edges of points that there are");
  fits(mesh.length_scale, points), fits(mesh.vertex_ids, points), fits(mesh.curve, points);
  fits(mesh.parameter, points), fits(mesh.vertex_keys, points), fits(mesh.steiner, points);
  fits(mesh.triangle_ids, triangles), fits(mesh.birth, triangles), fits(mesh.region, cells);
  fits(mesh.gradation_error, triangles), fits(mesh.fate, cells);
  for (const std::uint32_t region : mesh.region)
    require_pickle(region < mesh.region_names.size(), "regions that have names");
  for (const Fate fate : mesh.fate) require_pickle(fate <= Fate::made, "fates of cells");
  require_pickle(mesh.delaunay_slack_deg >= 0.0 && mesh.delaunay_slack_deg <= 60.0, "a slack of 0 to 60");
}

}  // namespace

py::object packed_mesh(const Snapshot& mesh) {
  return mesh ? packed(*mesh) : py::none();
}

Snapshot unpacked_mesh(const py::handle& from) {
  if (from.is_none()) return nullptr;
  auto mesh = std::make_shared<FrozenMesh>(unpacked<FrozenMesh>(from));
  require_sound(*mesh);
  return mesh;
}

}  // namespace python
}  // namespace remodel
