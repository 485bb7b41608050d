#include "io/vtk_grid.h"

#include <algorithm>
#include <cmath>

#include "io/assemble.h"
#include "io/plane_vectors.h"
#include "io/scanner.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

constexpr std::uint8_t vtk_vertex = 1;
constexpr std::uint8_t vtk_line = 3;
constexpr std::uint8_t vtk_triangle = 5;
constexpr std::uint8_t vtk_pixel = 8;
constexpr std::uint8_t vtk_quadrilateral = 9;
constexpr std::uint8_t vtk_second_order[] = {21, 22, 23, 28};  // a line, a triangle, quadrilaterals

template <class Indices>
void add_cell(VtkGrid& grid, const Indices& indices, std::uint8_t type, std::int32_t boundary) {
  grid.connectivity.insert(grid.connectivity.end(), indices.begin(), indices.end());
  grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
  grid.types.push_back(type);
  grid.boundary.push_back(boundary);
}

class GridReader {
 public:
  GridReader(const VtkGrid& grid, const std::string& file, const ArrayPlace& place, const Warnings& warnings)
      : grid_(grid), file_(file), place_(place), warnings_(warnings) {}

  FrozenMesh read() {
    check_sizes();
    check_points();
    for (const auto& name : grid_.boundary_names) {
      if (!names_.add(mesh_, name).second) {
        fail(boundary_names_array, in_quotes(name) + " found a second time, each name once expected");
      }
    }
    for (std::size_t cell = 0; cell < grid_.types.size(); ++cell) read_cell(cell);
    const std::vector<bool> used = used_points(mesh_, point_count());
    mesh_.points = in_their_plane(grid_.points, used, place_("Points"), warnings_);
    if (single_points_ > 0)
      warnings_.add(single_points_ == 1
                        ? "a cell of one point (type 1) is left out"
                        : std::to_string(single_points_) + " cells of one point (type 1) are left out");
    mesh_.length_scale = grid_.length_scale;
    mesh_.vertex_ids = grid_.vertex_id;
    mesh_.vertex_keys = grid_.vertex_key;
    mesh_.last_generation = grid_.last_generation;
    mesh_.curve = grid_.curve;
    mesh_.parameter = grid_.parameter;
    mesh_.steiner = grid_.steiner;
    if (grid_.periodic_names.size() % 2 != 0)
      fail(periodic_names_array,
           "found " + std::to_string(grid_.periodic_names.size()) + " names, pairs expected");
    for (std::size_t i = 0; i < grid_.periodic_names.size(); i += 2)
      mesh_.periodic.push_back({grid_.periodic_names[i], grid_.periodic_names[i + 1]});
    regions_.finish(mesh_);
    warnings_.note_unused_points(used, keep_used_points(mesh_, used));
    adopt_conventions(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::string_view array, const std::string& problem) const {
    throw Error(ErrorCode::format, place_(array), problem);
  }

  void expect_size(std::string_view array, std::size_t found, std::size_t expected) const {
    if (found == expected) return;
    fail(array, std::to_string(found) + " values found, " + std::to_string(expected) + " expected");
  }

  void check_sizes() const {
    if (grid_.points.size() % 3 != 0) fail("Points", "3 coordinates a point expected");
    const std::size_t points = point_count();
    const std::size_t cells = grid_.types.size();
    expect_size("Offsets", grid_.offsets.size(), cells + 1);
    for_each_point_array(grid_, [&](const char* name, const auto& values) {
      if (!values.empty()) expect_size(name, values.size(), points);
    });
    for_each_cell_array(grid_, [&](const char* name, const auto& values) {
      if (!values.empty()) expect_size(name, values.size(), cells);
    });
    for (const double value : grid_.length_scale) {
      if (!std::isfinite(value)) fail("length_scale", "a finite length scale expected");
    }
  }

  std::size_t point_count() const { return grid_.points.size() / 3; }

  void check_points() const {
    for (std::size_t i = 0; i + 2 < grid_.points.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::abs(grid_.points[i + k]) <= largest_coordinate)) {
          fail("Points", std::to_string(grid_.points[i + k]) + " found at point " + std::to_string(i / 3) +
                             ", a finite coordinate, at most 1e60 in size, expected");
        }
      }
    }
  }

  std::uint32_t vertex(std::size_t cell, std::size_t corner) const {
    const auto at = static_cast<std::size_t>(grid_.offsets[cell]) + corner;
    const std::int64_t index = grid_.connectivity[at];
    if (index < 0 || static_cast<std::uint64_t>(index) >= point_count()) {
      fail("Connectivity", "point " + std::to_string(index) + " found in cell " + std::to_string(cell) +
                               ", an index below " + std::to_string(point_count()) + " expected");
    }
    return static_cast<std::uint32_t>(index);
  }

  void check_extent(std::size_t cell, std::int64_t corners) const {
    const std::int64_t from = grid_.offsets[cell];
    const std::int64_t to = grid_.offsets[cell + 1];
    if (from < 0 || to < from || static_cast<std::uint64_t>(to) > grid_.connectivity.size() ||
        to - from != corners) {
      fail("Offsets", std::to_string(from) + " to " + std::to_string(to) + " found for cell " +
                          std::to_string(cell) + ", " + std::to_string(corners) +
                          " values of connectivity expected");
    }
  }

  void read_cell(std::size_t cell) {
    const auto type = grid_.types[cell];
    if (type == vtk_triangle) {
      check_extent(cell, 3);
      mesh_.triangles.push_back({vertex(cell, 0), vertex(cell, 1), vertex(cell, 2)});
      if (!grid_.triangle_id.empty()) mesh_.triangle_ids.push_back(grid_.triangle_id[cell]);
      if (!grid_.birth.empty()) mesh_.birth.push_back(grid_.birth[cell]);
      if (!grid_.region.empty()) regions_.add(mesh_, RegionNames::Cell::triangle, region_name(cell));
    } else if (type == vtk_quadrilateral || type == vtk_pixel) {
      check_extent(cell, 4);
      const std::size_t third = type == vtk_pixel ? 3 : 2;  // of a pixel's corners the last two are exchanged
      mesh_.quads.push_back({vertex(cell, 0), vertex(cell, 1), vertex(cell, third), vertex(cell, 5 - third)});
      if (!grid_.region.empty()) regions_.add(mesh_, RegionNames::Cell::quadrilateral, region_name(cell));
    } else if (type == vtk_line) {
      check_extent(cell, 2);
      boundary_of(cell).edges.push_back({vertex(cell, 0), vertex(cell, 1)});
    } else if (type == vtk_vertex) {
      ++single_points_;
    } else {
      const bool second = std::ranges::find(vtk_second_order, type) != std::end(vtk_second_order);
      fail("Types",
           "cell " + std::to_string(cell) + " of type " + std::to_string(type) +
               " found, only triangles (type 5), quadrilaterals (type 9) and lines (type 3) expected" +
               std::string(advice_on(second ? CellKind::second_order : CellKind::other)));
    }
  }

  std::string region_name(std::size_t cell) const {
    const std::int32_t index = grid_.region[cell];
    if (grid_.region_names.empty()) return "region_" + std::to_string(index);
    if (index < 0 || static_cast<std::size_t>(index) >= grid_.region_names.size()) {
      fail("region", std::to_string(index) + " found for cell " + std::to_string(cell) + ", an index below " +
                         std::to_string(grid_.region_names.size()) + " expected");
    }
    return grid_.region_names[static_cast<std::size_t>(index)];
  }

  FrozenBoundary& boundary_named(const std::string& name) {
    return mesh_.boundaries[names_.add(mesh_, name).first];
  }

  FrozenBoundary& boundary_of(std::size_t cell) {
    if (grid_.boundary.empty() && grid_.foreign_region && grid_.region[cell] != 0)
      return boundary_named("boundary_" + std::to_string(grid_.region[cell]));
    if (grid_.boundary.empty()) return boundary_named("boundary");
    const std::int32_t index = grid_.boundary[cell];
    if (grid_.boundary_names.empty()) return boundary_named("boundary_" + std::to_string(index));
    if (index < 0 || static_cast<std::size_t>(index) >= mesh_.boundaries.size()) {
      fail("boundary", std::to_string(index) + " found for cell " + std::to_string(cell) +
                           ", an index below " + std::to_string(mesh_.boundaries.size()) + " expected");
    }
    return mesh_.boundaries[static_cast<std::size_t>(index)];
  }

  const VtkGrid& grid_;
  const std::string& file_;
  const ArrayPlace& place_;
  const Warnings& warnings_;
  FrozenMesh mesh_;
  BoundaryNames names_;
  std::size_t single_points_ = 0;
  RegionNames regions_;
};

bool is_of_the_mesh(const std::string& name, FieldPlace place) {
  const VtkGrid none;
  bool found = false;
  const auto compare = [&](const char* other, const auto&) { found = found || name == other; };
  place == FieldPlace::vertices ? for_each_point_array(none, compare) : for_each_cell_array(none, compare);
  return found;
}

void add_fields(VtkGrid& grid, const FrozenMesh& mesh, std::span<const Field> fields) {
  require_fit(fields, mesh);
  std::vector<std::size_t> at_boundaries;
  for (const Field& field : fields) {
    if (is_of_the_mesh(field.name, field.place)) {
      throw Error(ErrorCode::argument, "field " + in_quotes(field.name),
                  "the name of an array that belongs to the mesh found, another expected");
    }
    const auto components = static_cast<std::size_t>(field.components);
    if (field.place == FieldPlace::vertices) {
      grid.point_fields.push_back({field.name, components, field.values});
      continue;
    }
    if (at_boundaries.empty()) at_boundaries = cells_at_boundaries(mesh);
    grid.cell_fields.push_back({field.name, components, field.values});
    auto& values = grid.cell_fields.back().values;
    for (const std::size_t cell : at_boundaries) {
      for (std::size_t k = 0; k < components; ++k)
        values.push_back(mesh.cell_count() == 0 ? 0.0 : field.values[components * cell + k]);
    }
  }
  for (auto* arrays : {&grid.point_fields, &grid.cell_fields})
    for (VtkArray& array : *arrays)
      if (array.components == 2) array = {array.name, 3, with_third_component(array.values), true};
}

}  // namespace

VtkGrid to_vtk_grid(const FrozenMesh& mesh, std::span<const Field> fields) {
  VtkGrid grid;
  for (const Point p : mesh.points) grid.points.insert(grid.points.end(), {p.x, p.y, 0.0});
  grid.offsets.push_back(0);
  for (const auto& triangle : mesh.triangles) add_cell(grid, triangle, vtk_triangle, -1);
  for (const auto& quad : mesh.quads) add_cell(grid, quad, vtk_quadrilateral, -1);
  for (std::size_t k = 0; k < mesh.boundaries.size(); ++k) {
    grid.boundary_names.push_back(mesh.boundaries[k].name);
    for (const auto& edge : mesh.boundaries[k].edges) {
      add_cell(grid, edge, vtk_line, static_cast<std::int32_t>(k));
    }
  }
  grid.triangle_id = mesh.triangle_ids;
  if (!mesh.triangle_ids.empty()) grid.triangle_id.resize(grid.types.size());
  grid.birth = mesh.birth;
  if (!mesh.birth.empty()) grid.birth.resize(grid.types.size());
  if (!mesh.region.empty()) {
    grid.region.assign(mesh.region.begin(), mesh.region.end());
    grid.region.resize(grid.types.size(), -1);
    grid.region_names = mesh.region_names;
  }
  for (const auto& pair : mesh.periodic)
    grid.periodic_names.insert(grid.periodic_names.end(), pair.begin(), pair.end());
  grid.length_scale = mesh.length_scale;
  grid.parameter = mesh.parameter;
  grid.vertex_id = mesh.vertex_ids;
  grid.vertex_key = mesh.vertex_keys;
  grid.last_generation = mesh.last_generation;
  grid.curve = mesh.curve;
  add_fields(grid, mesh, fields);
  grid.steiner = mesh.steiner;
  return grid;
}

std::optional<Field> to_field(VtkArray array, FieldPlace place, std::span<const std::uint8_t> types) {
  if (array.in_plane && array.components == 3 && take_third_component(array.values)) array.components = 2;
  const std::size_t components = array.components;
  if (components < 1 || components > 3 || is_of_the_mesh(array.name, place)) return std::nullopt;
  Field field{array.name, place, static_cast<int>(components), {}};
  if (place == FieldPlace::vertices) {
    field.values = std::move(array.values);
    return field;
  }
  const auto take = [&](auto&& wanted) {
    for (std::size_t cell = 0; cell < types.size(); ++cell) {
      if (!wanted(types[cell])) continue;
      const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(components * cell);
      field.values.insert(field.values.end(), first, first + static_cast<std::ptrdiff_t>(components));
    }
  };
  take([](std::uint8_t type) { return type == vtk_triangle; });
  take([](std::uint8_t type) { return type == vtk_quadrilateral || type == vtk_pixel; });
  return field;
}

std::vector<bool> used_points(const VtkGrid& cells, std::size_t points) {
  constexpr std::uint8_t taken[] = {vtk_triangle, vtk_pixel, vtk_quadrilateral};
  std::vector<bool> used(points);
  const auto end = static_cast<std::int64_t>(cells.connectivity.size());
  for (std::size_t cell = 0; cell < cells.types.size() && cell + 1 < cells.offsets.size(); ++cell) {
    if (std::ranges::find(taken, cells.types[cell]) == std::end(taken)) continue;
    const std::int64_t last = std::min(cells.offsets[cell + 1], end);
    for (std::int64_t at = std::max<std::int64_t>(cells.offsets[cell], 0); at < last; ++at) {
      const std::int64_t index = cells.connectivity[static_cast<std::size_t>(at)];
      if (index >= 0 && static_cast<std::uint64_t>(index) < points)
        used[static_cast<std::size_t>(index)] = true;
    }
  }
  return used;
}

FrozenMesh from_vtk_grid(const VtkGrid& grid, const std::string& file, const ArrayPlace& place,
                         const Warnings& warnings) {
  return GridReader(grid, file, place, warnings).read();
}

}  // namespace remodel::io
