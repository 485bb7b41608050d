#pragma once

// A mesh as VTK's unstructured grid, the model behind both .vtu and .vtkhdf: triangles,
// quadrilaterals and boundary edges are cells; arrays on points and cells carry what else a frozen mesh
// knows.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/foreign.h"
#include "remodel/field.h"
#include "remodel/frozen_mesh.h"

namespace remodel::io {

// An array that is no part of a mesh: a field's.
struct VtkArray {
  std::string name;
  std::size_t components;
  std::vector<double> values;
  bool in_plane = false;  // it has plane_mark: the third component was added
};

struct VtkGrid {
  std::vector<double> points;  // 3 a point
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;  // one more than cells, from 0
  std::vector<std::uint8_t> types;
  std::vector<std::string> boundary_names, region_names;
  std::vector<std::string> periodic_names;  // of boundaries, in pairs
  bool foreign_region = false;              // region is another program's array, which lines have too
  std::uint32_t last_generation = 0;        // of vertex_key

  // Per cell. boundary: index into boundary_names, -1 for cells of the domain. The others are empty or hold 0
  // where they say nothing.
  std::vector<std::int32_t> boundary;
  std::vector<std::uint32_t> triangle_id, birth;
  std::vector<std::int32_t> region;  // index into region_names; -1 for edges
  // Per point, each may be empty.
  std::vector<double> length_scale, parameter;
  std::vector<std::uint32_t> vertex_id;
  std::vector<std::uint64_t> vertex_key;
  std::vector<std::int32_t> curve;
  std::vector<std::uint8_t> steiner;
  // The fields' values, for writing.
  std::vector<VtkArray> point_fields, cell_fields;
};

inline constexpr std::string_view boundary_names_array = "boundary_names";
inline constexpr std::string_view region_names_array = "region_names";
inline constexpr std::string_view periodic_names_array = "periodic_boundaries";
inline constexpr std::string_view last_generation_array = "last_generation";
// What other programs call the array that says which part of the domain a cell is in.
inline constexpr const char* foreign_region_arrays[] = {"gmsh:physical", "CellEntityIds", "MaterialIds"};

// visit(name, vector) for each array, in the order in which it is written.
template <class Grid, class Visitor>
void for_each_point_array(Grid& grid, Visitor&& visit) {
  visit("length_scale", grid.length_scale);
  visit("vertex_id", grid.vertex_id);
  visit("vertex_key", grid.vertex_key);
  visit("curve", grid.curve);
  visit("parameter", grid.parameter);
  visit("steiner", grid.steiner);
}
template <class Grid, class Visitor>
void for_each_cell_array(Grid& grid, Visitor&& visit) {
  visit("boundary", grid.boundary);
  visit("triangle_id", grid.triangle_id);
  visit("birth", grid.birth);
  visit("region", grid.region);
}

// A boundary edge's cell has the value of the domain's cell beside it. Throws Error (argument) for fields
// that do not fit the mesh or have the name of one of its own arrays.
VtkGrid to_vtk_grid(const FrozenMesh& mesh, std::span<const Field> fields = {});

// The field of an array in a file, on the vertices or cells of the frozen mesh that from_vtk_grid()
// makes. Nothing if it is an array of the mesh itself or has more than three components. An array that is
// in_plane loses its third component, unless it holds something by now.
std::optional<Field> to_field(VtkArray array, FieldPlace place, std::span<const std::uint8_t> types);

// Which points triangles and quadrilaterals have. What is out of range is passed over.
std::vector<bool> used_points(const VtkGrid& cells, std::size_t points);

// place names an array of the file for messages ("FILE:LINE", "FILE:/VTKHDF/Types").
using ArrayPlace = std::function<std::string(std::string_view array)>;

// Checks sizes and indices, takes triangles, quadrilaterals and lines, leaves out points that none of them
// has, and brings the mesh into our conventions.
FrozenMesh from_vtk_grid(const VtkGrid& grid, const std::string& file, const ArrayPlace& place,
                         const Warnings& warnings);

}  // namespace remodel::io
