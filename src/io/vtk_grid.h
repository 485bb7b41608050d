#pragma once

// A mesh as VTK's unstructured grid, the model behind both .vtu and .vtkhdf: triangles and boundary edges are
// cells; arrays on points and cells carry what else a frozen mesh knows.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel::io {

struct VtkGrid {
  std::vector<double> points;  // 3 a point
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;  // one more than cells, from 0
  std::vector<std::uint8_t> types;
  std::vector<std::string> boundary_names;

  // Per cell. boundary: index into boundary_names, -1 for triangles. The others are empty or hold 0 for
  // edges.
  std::vector<std::int32_t> boundary;
  std::vector<std::uint32_t> triangle_id, birth;
  // Per point, each may be empty.
  std::vector<double> length_scale, parameter;
  std::vector<std::uint32_t> vertex_id;
  std::vector<std::int32_t> curve;
};

inline constexpr std::string_view boundary_names_array = "boundary_names";

// visit(name, vector) for each array, in the order in which it is written.
template <class Grid, class Visitor>
void for_each_point_array(Grid& grid, Visitor&& visit) {
  visit("length_scale", grid.length_scale);
  visit("vertex_id", grid.vertex_id);
  visit("curve", grid.curve);
  visit("parameter", grid.parameter);
}
template <class Grid, class Visitor>
void for_each_cell_array(Grid& grid, Visitor&& visit) {
  visit("boundary", grid.boundary);
  visit("triangle_id", grid.triangle_id);
  visit("birth", grid.birth);
}

VtkGrid to_vtk_grid(const FrozenMesh& mesh);

// place names an array of the file for messages ("FILE:LINE", "FILE:/VTKHDF/Types").
using ArrayPlace = std::function<std::string(std::string_view array)>;

// Checks sizes and indices, takes triangles and lines, and brings them into our conventions.
FrozenMesh from_vtk_grid(const VtkGrid& grid, const std::string& file, const ArrayPlace& place);

}  // namespace remodel::io
