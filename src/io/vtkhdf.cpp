#include "io/vtkhdf.h"

#include "base/checksum.h"
#include "io/assemble.h"
#include "io/hdf5_file.h"
#include "io/plane_vectors.h"
#include "io/scanner.h"
#include "io/state_parts.h"
#include "io/vtk_grid.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/mesh_state.h"

namespace remodel::io {

namespace {

constexpr std::int64_t state_version = 6;
const std::string grid_group = "/VTKHDF/";
const std::string state_group = "/remodel";
const std::string boxes_path = "/VTKHDF/FieldData/su2_boxes";
const std::string markers_path = state_group + "/imported_markers";

const std::string reference_group = state_group + "/reference";

// What a layered mesh has beside its outer mesh.
const std::string layers_group = state_group + "/layers";
const std::string layer_walls_path = layers_group + "/walls", layer_names_path = layers_group + "/names";
const std::string layer_fans_path = layers_group + "/fans", layer_columns_path = layers_group + "/columns";

template <class State, class Visitor>
void for_each_layer_number(State& state, Visitor&& visit) {
  visit("first_height", state.options.first_height);
  visit("growth", state.options.growth);
  visit("thickness", state.options.thickness);
  visit("fan_from_deg", state.options.fan_from_deg);
  visit("levels", state.levels);
  visit("next_column", state.next_column);
}

std::uint64_t checksum_of_layers(const LayeredState& state, const std::string& walls_text) {
  WordChecksum sum;
  for_each_layer_number(state, [&](const char*, auto value) { sum.add(value); });
  for (const std::string& name : state.options.walls) sum.add(name);
  for (const auto* numbers : {&state.fans, &state.columns})
    for (const auto& ring : *numbers) {
      sum.add(std::uint64_t{ring.size()});
      for (const std::uint32_t number : ring) sum.add(number);
    }
  sum.add(walls_text);
  return sum.value();
}

// ------------------------------------------------------------------------------------------------ writing

void write_fields(Hdf5Writer& out, const std::string& group, const std::vector<VtkArray>& arrays) {
  for (const auto& [name, components, values, in_plane] : arrays) {
    if (name == "." || name.find('/') != std::string::npos) {
      throw Error(ErrorCode::argument, "field " + in_quotes(name),
                  "a name with '/' or the name '.' found, VTKHDF expects another");
    }
    out.array(group + name, values, components);
    if (in_plane) out.attribute(group + name, plane_mark, std::vector<std::int32_t>{2});
  }
}

// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html, one
// partition
void write_grid(Hdf5Writer& out, const VtkGrid& grid, const std::string& boxes) {
  out.group("/VTKHDF");
  out.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  out.attribute("/VTKHDF", "Type", "UnstructuredGrid");
  const auto number = [&](const char* name, std::size_t value) {
    out.array(grid_group + name, std::vector<std::int64_t>{static_cast<std::int64_t>(value)});
  };
  number("NumberOfPoints", grid.points.size() / 3);
  number("NumberOfCells", grid.types.size());
  number("NumberOfConnectivityIds", grid.connectivity.size());
  out.array(grid_group + "Points", grid.points, 3);
  out.array(grid_group + "Connectivity", grid.connectivity);
  out.array(grid_group + "Offsets", grid.offsets);
  out.array(grid_group + "Types", grid.types);
  out.group("/VTKHDF/PointData");
  for_each_point_array(grid, [&](const std::string& name, const auto& values) {
    if (!values.empty()) out.array("/VTKHDF/PointData/" + name, values);
  });
  write_fields(out, "/VTKHDF/PointData/", grid.point_fields);
  out.group("/VTKHDF/CellData");
  for_each_cell_array(grid, [&](const std::string& name, const auto& values) {
    if (!values.empty()) out.array("/VTKHDF/CellData/" + name, values);
  });
  write_fields(out, "/VTKHDF/CellData/", grid.cell_fields);
  out.group("/VTKHDF/FieldData");
  if (!grid.boundary_names.empty()) {
    out.texts("/VTKHDF/FieldData/" + std::string(boundary_names_array), grid.boundary_names);
  }
  if (!grid.region_names.empty()) {
    out.texts("/VTKHDF/FieldData/" + std::string(region_names_array), grid.region_names);
  }
  if (!grid.periodic_names.empty())
    out.texts("/VTKHDF/FieldData/" + std::string(periodic_names_array), grid.periodic_names);
  if (!boxes.empty()) out.texts(boxes_path, {boxes});
  if (!grid.vertex_key.empty()) {
    out.array("/VTKHDF/FieldData/" + std::string(last_generation_array), std::vector{grid.last_generation});
  }
}

bool has_reference(const MeshState& state) {
  return !state.reference_coordinates.empty();
}

void write_reference(Hdf5Writer& out, const MeshState& state) {
  out.group(reference_group);
  out.attribute(reference_group, "delaunay_slack_deg", std::vector{state.delaunay_slack_deg});
  for_each_reference_array(state, [&](const std::string& name, const auto& values, std::size_t columns) {
    out.array(reference_group + "/" + name, values, columns);
  });
  out.text(reference_group + "/domain", domain_to_json(state.reference_domain));
}

void write_layers(Hdf5Writer& out, const LayeredState& state) {
  const std::string walls = domain_to_json(state.walls);
  out.group(layers_group);
  out.attribute(layers_group, "checksum", std::vector<std::uint64_t>{checksum_of_layers(state, walls)});
  for_each_layer_number(state, [&](const std::string& name, const auto& value) {
    out.attribute(layers_group, name, std::vector{value});
  });
  if (!state.options.walls.empty()) out.texts(layer_names_path, state.options.walls);
  for (std::size_t r = 0; r < state.fans.size(); ++r) {
    out.array(layer_fans_path + std::to_string(r), state.fans[r]);
    out.array(layer_columns_path + std::to_string(r), state.columns[r]);
  }
  out.text(layer_walls_path, walls);
}

void write_state(Hdf5Writer& out, const MeshState& state) {
  const std::string domain = domain_to_json(state.domain);
  out.group(state_group);
  out.attribute(state_group, "format_version", std::vector<std::int64_t>{state_version});
  out.attribute(state_group, "checksum", std::vector<std::uint64_t>{checksum_of(state, domain)});
  for_each_state_number(state, [&](const std::string& name, const auto& value) {
    out.attribute(state_group, name, std::vector{value});
  });
  for_each_state_array(state, [&](const std::string& name, const auto& values, std::size_t columns) {
    out.array(state_group + "/" + name, values, columns);
  });
  if (!state.imported.markers.empty()) out.texts(markers_path, state.imported.markers);
  out.text(state_group + "/domain", domain);
  if (has_reference(state)) write_reference(out, state);
}

// ------------------------------------------------------------------------------------------------ reading

void check_header(const Hdf5Reader& in) {
  if (!in.exists("/VTKHDF")) in.fail("/VTKHDF", "not found, a VTKHDF file expected");
  const auto version = in.attribute<std::int64_t>("/VTKHDF", "Version");
  if (version.size() != 2 || version[0] < 1 || version[0] > 2) {
    in.fail("/VTKHDF@Version", "version " + std::to_string(version[0]) + " found, 1 or 2 expected");
  }
  if (const auto type = in.text_attribute("/VTKHDF", "Type"); type != "UnstructuredGrid") {
    in.fail("/VTKHDF@Type", in_quotes(type) + " found, 'UnstructuredGrid' expected");
  }
}

// Sums over partitions would need their offsets shifted: one partition is what a mesh of ours has.
void check_number(const Hdf5Reader& in, const char* name, std::size_t expected) {
  const auto found = in.array<std::int64_t>(grid_group + name);
  if (found.size() != 1) {
    in.fail(grid_group + name, std::to_string(found.size()) + " partitions found, one expected");
  }
  if (found[0] < 0 || static_cast<std::uint64_t>(found[0]) != expected) {
    in.fail(grid_group + name,
            std::to_string(found[0]) + " found, " + std::to_string(expected) + " expected");
  }
}

template <class Value>
void read_optional(const Hdf5Reader& in, const std::string& path, std::vector<Value>& values) {
  if (in.exists(path)) values = in.array<Value>(path);
}

VtkGrid read_grid(const Hdf5Reader& in) {
  VtkGrid grid;
  grid.points = in.array<double>(grid_group + "Points");
  grid.connectivity = in.array<std::int64_t>(grid_group + "Connectivity");
  grid.offsets = in.array<std::int64_t>(grid_group + "Offsets");
  grid.types = in.array<std::uint8_t>(grid_group + "Types");
  check_number(in, "NumberOfPoints", grid.points.size() / 3);
  check_number(in, "NumberOfCells", grid.types.size());
  check_number(in, "NumberOfConnectivityIds", grid.connectivity.size());
  for_each_point_array(grid, [&](const std::string& name, auto& values) {
    read_optional(in, "/VTKHDF/PointData/" + name, values);
  });
  for_each_cell_array(grid, [&](const std::string& name, auto& values) {
    read_optional(in, "/VTKHDF/CellData/" + name, values);
  });
  for (const char* name : foreign_region_arrays)
    if (grid.region.empty()) {
      read_optional(in, std::string("/VTKHDF/CellData/") + name, grid.region);
      grid.foreign_region = !grid.region.empty();
    }
  const std::string names = "/VTKHDF/FieldData/" + std::string(boundary_names_array);
  if (in.exists(names)) grid.boundary_names = in.texts(names);
  const std::string regions = "/VTKHDF/FieldData/" + std::string(region_names_array);
  if (in.exists(regions)) grid.region_names = in.texts(regions);
  const std::string periodic = "/VTKHDF/FieldData/" + std::string(periodic_names_array);
  if (in.exists(periodic)) grid.periodic_names = in.texts(periodic);
  std::vector<std::uint32_t> last_generation;
  read_optional(in, "/VTKHDF/FieldData/" + std::string(last_generation_array), last_generation);
  if (!last_generation.empty()) grid.last_generation = last_generation.front();
  return grid;
}

bool is_marked_plane(const Hdf5Reader& in, const std::string& path) {
  return in.has_attribute(path, plane_mark) && in.attribute<std::int32_t>(path, plane_mark).front() == 2;
}

void add_fields(std::vector<Field>& fields, const Hdf5Reader& in, FieldPlace place, std::size_t places,
                std::span<const std::uint8_t> types) {
  const std::string group = place == FieldPlace::vertices ? "/VTKHDF/PointData" : "/VTKHDF/CellData";
  for (const std::string& name : in.real_arrays(group)) {
    const std::string path = group + "/" + name;
    const std::size_t components = in.columns(path);
    if (components < 1 || components > 3) continue;
    VtkArray array{name, components, in.array<double>(path), is_marked_plane(in, path)};
    if (array.values.size() != components * places) {
      in.fail(path, std::to_string(array.values.size()) + " values found, " +
                        std::to_string(components * places) + " expected");
    }
    if (auto field = to_field(std::move(array), place, types)) fields.push_back(std::move(*field));
  }
}

// A text that is none of SU2's boxes would spoil the file that it is written to.
std::string boxes_in(const Hdf5Reader& in) {
  if (!in.exists(boxes_path)) return {};
  const std::vector<std::string> texts = in.texts(boxes_path);
  if (texts.size() != 1 || !texts.front().starts_with("FFD_"))
    in.fail(boxes_path, "another text found, SU2's lines that begin with FFD_ expected");
  return texts.front();
}

std::string place_of(const Hdf5Reader& in, std::string_view array) {
  for (const char* group : {"/VTKHDF/", "/VTKHDF/PointData/", "/VTKHDF/CellData/", "/VTKHDF/FieldData/"}) {
    if (const std::string path = group + std::string(array); in.exists(path)) return in.place(path);
  }
  return in.place("/VTKHDF");
}

}  // namespace

std::uint64_t checksum_of(const MeshState& state, const std::string& domain_text) {
  WordChecksum sum;
  for_each_state_number(state, [&](const char*, auto value) { sum.add(value); });
  for_each_state_array(state, [&](const char*, const auto& values, std::size_t) {
    sum.add(std::uint64_t{values.size()});
    for (const auto value : values) sum.add(value);
  });
  for (const std::string& marker : state.imported.markers) sum.add(marker);
  sum.add(domain_text);
  if (has_reference(state)) {
    sum.add(state.delaunay_slack_deg);
    for_each_reference_array(state, [&](const char*, const auto& values, std::size_t) {
      for (const auto value : values) sum.add(value);
    });
    sum.add(domain_to_json(state.reference_domain));
  }
  return sum.value();
}

void write_vtkhdf(const std::filesystem::path& file, const FrozenMesh& mesh, const MeshState* state,
                  const WriteOptions& options) {
  Hdf5Writer out(file.string());
  write_grid(out, to_vtk_grid(mesh, options.fields), options.su2_boxes);
  if (state != nullptr) write_state(out, *state);
  write_text_atomically(file, out.sealed());
}

// One view after the other: each is as large as the mesh.
void write_vtkhdf(const std::filesystem::path& file, const Mesh& mesh, const WriteOptions& options) {
  Hdf5Writer out(file.string());
  {
    const VtkGrid grid = to_vtk_grid(mesh.freeze(), options.fields);
    write_grid(out, grid, options.su2_boxes);
  }
  write_state(out, mesh.state());
  write_text_atomically(file, out.sealed());
}

void write_vtkhdf(const std::filesystem::path& file, const LayeredMesh& mesh, const WriteOptions& options,
                  LayerCells cells) {
  Hdf5Writer out(file.string());
  {
    const VtkGrid grid = to_vtk_grid(mesh.freeze(cells), options.fields);
    write_grid(out, grid, options.su2_boxes);
  }
  const LayeredState state = mesh.state();
  write_state(out, state.outer);
  write_layers(out, state);
  write_text_atomically(file, out.sealed());
}

FrozenMesh read_vtkhdf_frozen(const std::filesystem::path& file, ReadNotes* notes) {
  const Hdf5Reader in(file);
  check_header(in);
  if (notes != nullptr) notes->su2_boxes = boxes_in(in);
  return from_vtk_grid(
      read_grid(in), file.string(), [&](std::string_view array) { return place_of(in, array); },
      Warnings(notes, file.string()));
}

std::string read_vtkhdf_boxes(const std::filesystem::path& file) {
  return boxes_in(Hdf5Reader(file));
}

std::vector<Field> read_vtkhdf_fields(const std::filesystem::path& file) {
  const Hdf5Reader in(file);
  check_header(in);
  VtkGrid grid;
  grid.connectivity = in.array<std::int64_t>(grid_group + "Connectivity");
  grid.offsets = in.array<std::int64_t>(grid_group + "Offsets");
  grid.types = in.array<std::uint8_t>(grid_group + "Types");
  const auto points = in.array<std::int64_t>(grid_group + "NumberOfPoints");
  if (points.size() != 1 || points.front() < 0) in.fail(grid_group + "NumberOfPoints", "one number expected");
  std::vector<Field> fields;
  const auto count = static_cast<std::size_t>(points.front());
  add_fields(fields, in, FieldPlace::vertices, count, grid.types);
  add_fields(fields, in, FieldPlace::triangles, grid.types.size(), grid.types);
  if (!fields.empty() && fields.front().place == FieldPlace::vertices)
    keep_used_points(fields, used_points(grid, count));
  return fields;
}

namespace {

void require_state(const Hdf5Reader& in) {
  check_header(in);
  if (!in.exists(state_group)) {
    throw Error(ErrorCode::argument, in.place(state_group),
                "not found, a native mesh with its state expected, as `remodel mesh` makes it");
  }
}

MeshState read_state(const Hdf5Reader& in) {
  const auto version = in.attribute<std::int64_t>(state_group, "format_version");
  if (version[0] != state_version) {
    in.fail(state_group + "@format_version",
            std::to_string(version[0]) + " found, " + std::to_string(state_version) + " expected");
  }
  MeshState state;
  for_each_state_number(state, [&](const std::string& name, auto& value) {
    value = in.attribute<std::remove_reference_t<decltype(value)>>(state_group, name).front();
  });
  for_each_state_array(state, [&](const std::string& name, auto& values, std::size_t) {
    values =
        in.array<typename std::remove_reference_t<decltype(values)>::value_type>(state_group + "/" + name);
  });
  if (in.exists(reference_group)) {
    state.delaunay_slack_deg = in.attribute<double>(reference_group, "delaunay_slack_deg").front();
    for_each_reference_array(state, [&](const std::string& name, auto& values, std::size_t) {
      values = in.array<double>(reference_group + "/" + name);
    });
    const std::string path = reference_group + "/domain";
    state.reference_domain = domain_from_json(in.text(path), in.place(path));
  }
  if (in.exists(markers_path)) state.imported.markers = in.texts(markers_path);
  const std::string domain = in.text(state_group + "/domain");
  if (in.attribute<std::uint64_t>(state_group, "checksum").front() != checksum_of(state, domain)) {
    in.fail(state_group + "@checksum",
            "another checksum than that of the content found: the file is damaged");
  }
  state.domain = domain_from_json(domain, in.place(state_group + "/domain"));
  return state;
}

}  // namespace

MeshState read_vtkhdf_state(const std::filesystem::path& file) {
  const Hdf5Reader in(file);
  require_state(in);
  if (in.exists(layers_group))
    in.fail(layers_group, "a mesh with layers found, one without expected: `remodel update` goes on from it");
  return read_state(in);
}

bool holds_vtkhdf_layers(const std::filesystem::path& file) {
  return Hdf5Reader(file).exists(layers_group);
}

LayeredState read_vtkhdf_layers(const std::filesystem::path& file) {
  const Hdf5Reader in(file);
  require_state(in);
  if (!in.exists(layers_group))
    throw Error(ErrorCode::argument, in.place(layers_group),
                "not found, a native mesh with layers expected, as `remodel mesh --layers` makes it");
  LayeredState state;
  state.outer = read_state(in);
  for_each_layer_number(state, [&](const std::string& name, auto& value) {
    value = in.attribute<std::remove_reference_t<decltype(value)>>(layers_group, name).front();
  });
  if (in.exists(layer_names_path)) state.options.walls = in.texts(layer_names_path);
  for (std::size_t r = 0; in.exists(layer_fans_path + std::to_string(r)); ++r) {
    state.fans.push_back(in.array<std::uint32_t>(layer_fans_path + std::to_string(r)));
    state.columns.push_back(in.array<std::uint32_t>(layer_columns_path + std::to_string(r)));
  }
  const std::string walls = in.text(layer_walls_path);
  if (in.attribute<std::uint64_t>(layers_group, "checksum").front() != checksum_of_layers(state, walls))
    in.fail(layers_group + "@checksum",
            "another checksum than that of the content found: the file is damaged");
  state.walls = domain_from_json(walls, in.place(layer_walls_path));
  return state;
}

}  // namespace remodel::io
