// FrozenMesh: a mesh as read-only arrays, its validation, files and pictures.

#include "apart.h"
#include "bindings.h"
#include "living.h"
#include "records.h"
#include "remodel/check.h"
#include "remodel/draw.h"
#include "remodel/io.h"

namespace remodel {

template <python::Is<Violation> T>
auto members(T& v) {
  return std::tie(v.rule, v.ids, v.detail);
}
template <python::Is<CheckResult> T>
auto members(T& r) {
  return std::tie(r.valid, r.violations, r.triangles, r.vertices, r.unused_points, r.min_angle_deg,
                  r.min_held_angle_deg, r.exempt_triangles, r.max_gradation, r.delaunay, r.boundary,
                  r.regions, r.area, r.quadrilaterals, r.least_corner_deg, r.largest_corner_deg);
}

}  // namespace remodel

namespace remodel::python {
namespace {

using FrozenPointer = std::shared_ptr<FrozenMesh>;

py::dict boundaries(const Snapshot& mesh) {
  py::dict result;
  for (const FrozenBoundary& boundary : mesh->boundaries) {
    const auto* first = boundary.edges.empty() ? nullptr : boundary.edges.front().data();
    result[py::str(boundary.name)] = view(mesh, first, {static_cast<py::ssize_t>(boundary.edges.size()), 2});
  }
  return result;
}

// Regions, length scales and so on: whatever else the mesh carries.
void add_columns(py::class_<FrozenMesh, FrozenPointer>& type) {
  type.def_property_readonly(
      "vertex_ids", [](const FrozenPointer& m) { return view(m, m->vertex_ids); },
      "Per point: the vertex's id, stable while it lives.");
  type.def_property_readonly(
      "vertex_keys", [](const FrozenPointer& m) { return view(m, m->vertex_keys); },
      "Per point: a number that is never given to another vertex of this mesh.");
  type.def_property_readonly("triangle_ids", [](const FrozenPointer& m) { return view(m, m->triangle_ids); });
  type.def_property_readonly(
      "birth", [](const FrozenPointer& m) { return view(m, m->birth); },
      "Per triangle: the step that made it; 0 is generation.");
  type.def_property_readonly(
      "length_scale", [](const FrozenPointer& m) { return view(m, m->length_scale); },
      "Per point, in chords.");
  type.def_property_readonly(
      "curve", [](const FrozenPointer& m) { return view(m, m->curve); },
      "Per point: the index of its curve, -1 in the interior.");
  type.def_property_readonly(
      "parameter", [](const FrozenPointer& m) { return view(m, m->parameter); },
      "Per point: t on that curve.");
  type.def_readonly("delaunay_slack", &FrozenMesh::delaunay_slack_deg,
                    "By how much the angles opposite an inner edge may exceed 180 degrees; 0: Delaunay.");
  type.def_property_readonly("region", [](const FrozenPointer& m) { return view(m, m->region); });
  type.def_readonly("region_names", &FrozenMesh::region_names);
}

std::vector<Field> fields_from(const py::dict& fields, const FrozenMesh& mesh) {
  std::vector<Field> result;
  for (const auto& [key, value] : fields) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error("fields: found " + type_of(key) + ", expected names of fields");
    const Reals values = array_of(value, key.cast<std::string>());
    if (values.ndim() != 1 && values.ndim() != 2)
      throw Error(ErrorCode::argument, key.cast<std::string>(),
                  "expected values of shape (n,) or (n, components)");
    Field field{.name = key.cast<std::string>(),
                .components = values.ndim() == 2 ? static_cast<int>(values.shape(1)) : 1,
                .values = {}};
    const auto count = static_cast<std::size_t>(values.shape(0));
    if (count != mesh.points.size() && count == mesh.cell_count()) field.place = FieldPlace::triangles;
    field.values.assign(values.data(), values.data() + values.size());
    result.push_back(std::move(field));
  }
  return result;
}

// Arrays of point indices of shape (n, columns). Throws Error (argument) for another shape and other numbers.
std::vector<std::vector<std::uint32_t>> indices(const py::object& values, py::ssize_t columns,
                                                const std::string& name, std::size_t count) {
  const auto numbers = py::module_::import("numpy").attr("asarray")(values).cast<py::array>();
  const char kind = numbers.dtype().kind();
  if (numbers.size() > 0 && kind != 'i' && kind != 'u')
    throw Error(
        ErrorCode::argument, name,
        "found values of type " + py::str(numbers.dtype()).cast<std::string>() + ", expected integers");
  if (numbers.ndim() != 2 || numbers.shape(1) != columns)
    throw Error(ErrorCode::argument, name,
                "found an array of shape " + py::str(numbers.attr("shape")).cast<std::string>() +
                    ", expected (n, " + std::to_string(columns) + ")");
  const auto rows = numbers.cast<py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>>();
  std::vector<std::vector<std::uint32_t>> result(static_cast<std::size_t>(rows.shape(0)));
  for (py::ssize_t i = 0; i < rows.shape(0); ++i)
    for (py::ssize_t k = 0; k < columns; ++k) {
      const std::int64_t value = *rows.data(i, k);
      if (value < 0 || value >= static_cast<std::int64_t>(count))
        throw Error(ErrorCode::argument, name,
                    "row " + std::to_string(i) + ": found " + std::to_string(value) + ", expected 0 to " +
                        std::to_string(count) + " - 1");
      result[static_cast<std::size_t>(i)].push_back(static_cast<std::uint32_t>(value));
    }
  return result;
}

// The names and the numbers of the cells' regions.
void set_regions(FrozenMesh& mesh, const py::object& regions, const std::vector<std::string>& names) {
  if (regions.is_none() && names.empty()) return;
  if (regions.is_none() || names.empty())
    throw Error(ErrorCode::argument, "region, region_names", "found one of them, expected both");
  const py::object column = py::module_::import("numpy").attr("reshape")(regions, py::make_tuple(-1, 1));
  mesh.region_names = names;
  for (const auto& row : indices(column, 1, "region", names.size())) mesh.region.push_back(row[0]);
  if (mesh.region.size() != mesh.cell_count())
    throw Error(ErrorCode::argument, "region",
                "found " + std::to_string(mesh.region.size()) + " values, expected one a " +
                    (mesh.quads.empty() ? "triangle, " : "cell, ") + std::to_string(mesh.cell_count()));
}

FrozenPointer from_arrays(const Reals& coordinates, const py::object& triangles, const py::dict& named,
                          const py::object& quads, const py::object& regions,
                          const std::vector<std::string>& region_names) {
  auto mesh = std::make_shared<FrozenMesh>();
  mesh->points = points(coordinates, "points");
  const std::size_t count = mesh->points.size();
  for (const auto& row : indices(triangles, 3, "triangles", count))
    mesh->triangles.push_back({row[0], row[1], row[2]});
  if (!quads.is_none())
    for (const auto& row : indices(quads, 4, "quads", count))
      mesh->quads.push_back({row[0], row[1], row[2], row[3]});
  for (const auto& [name, value] : named) {
    if (!py::isinstance<py::str>(name))
      throw py::type_error("boundaries: found " + type_of(name) + ", expected names of boundaries");
    FrozenBoundary boundary{.name = name.cast<std::string>(), .edges = {}};
    for (const auto& row : indices(py::reinterpret_borrow<py::object>(value), 2, boundary.name, count))
      boundary.edges.push_back({row[0], row[1]});
    mesh->boundaries.push_back(std::move(boundary));
  }
  set_regions(*mesh, regions, region_names);
  return mesh;
}

FrozenPointer with_points(const FrozenPointer& mesh, const Reals& coordinates) {
  auto result = std::make_shared<FrozenMesh>(*mesh);
  result->points = points(coordinates, "points");
  if (result->points.size() != mesh->points.size())
    throw Error(ErrorCode::argument, "points",
                "found " + std::to_string(result->points.size()) + " points, expected " +
                    std::to_string(mesh->points.size()));
  return result;
}

void add_check(py::module_& module) {
  py::class_<Violation>(module, "Violation", "A broken rule, with the points or cells concerned.")
      .def_readonly("rule", &Violation::rule, "The name of the rule (include/remodel/check.h).")
      .def_readonly("ids", &Violation::ids, "The points or cells concerned, by their indices.")
      .def_readonly("detail", &Violation::detail, "One sentence.")
      .def(record_pickle<Violation>())
      .def("__repr__", [](const Violation& v) { return "Violation(" + v.rule + ": " + v.detail + ")"; });
  py::class_<CheckResult>(module, "CheckResult",
                          "The verdict of the independent validator, which works in rational arithmetic.")
      .def_readonly("valid", &CheckResult::valid, "Whether no rule is broken.")
      .def_readonly("violations", &CheckResult::violations, "The broken rules: a list of Violation.")
      .def_readonly("triangles", &CheckResult::triangles, "How many there are.")
      .def_readonly("quadrilaterals", &CheckResult::quadrilaterals, "How many there are.")
      .def_readonly("vertices", &CheckResult::vertices, "How many points are of cells.")
      .def_readonly("min_angle_deg", &CheckResult::min_angle_deg,
                    "The smallest angle of all triangles but those of layers, in degrees.")
      .def_readonly("max_gradation", &CheckResult::max_gradation,
                    "The largest circumradius over what the length scales allow; nan without any.")
      .def_readonly("delaunay", &CheckResult::delaunay,
                    "Whether the mesh is constrained Delaunay, without any slack.")
      .def_readonly("boundary", &CheckResult::boundary, "The number of edges of each boundary, by name.")
      .def_readonly("area", &CheckResult::area, "Of all cells, in square chords.")
      .def(record_pickle<CheckResult>())
      .def("__bool__", [](const CheckResult& r) { return r.valid; })
      .def("__repr__", [](const CheckResult& r) {
        return std::string("CheckResult(valid=") + (r.valid ? "True" : "False") +
               ", triangles=" + std::to_string(r.triangles) + ")";
      });
  module.def(
      "check",
      [](const py::object& mesh, double min_angle, double max_gradation, bool delaunay,
         const std::optional<double>& delaunay_slack) {
        const Snapshot frozen = snapshot_of(mesh);
        const CheckOptions options{.min_angle_deg = min_angle,
                                   .max_gradation = max_gradation,
                                   .delaunay = delaunay,
                                   .delaunay_slack_deg = delaunay_slack.value_or(frozen->delaunay_slack_deg)};
        return Apart().run(std::make_shared<Stop>(), [frozen, options] { return check(*frozen, options); });
      },
      "mesh"_a, py::kw_only(), "min_angle"_a = 0.0, "max_gradation"_a = 0.0, "delaunay"_a = true,
      "delaunay_slack"_a = py::none(),
      "Validates a Mesh or FrozenMesh of any origin. min_angle is in degrees; 0 tests no bound. "
      "delaunay_slack: degrees by which the angles opposite an inner edge may exceed 180, 0 to 60; the "
      "mesh's "
      "own unless given, which is 0 but for meshes that are held.");
}

}  // namespace

void add_snapshots(py::module_& module) {
  py::class_<FrozenMesh, FrozenPointer> type(
      module, "FrozenMesh",
      R"(A mesh as read-only numpy arrays, at one moment of its life. Arrays are views: they are not
copied, and they stay valid whatever happens to the living mesh.

FrozenMesh(points, triangles, boundaries) takes the arrays of another program: boundaries are pairs of points by name;
quads are quadrilaterals. The cells of a mesh are its triangles, then its quadrilaterals: region says of each which of
region_names it lies in, and fields on cells have their values in that order. import_mesh() brings it to life.)");
  type.def(py::init(&from_arrays), "points"_a, "triangles"_a, "boundaries"_a = py::dict(), py::kw_only(),
           "quads"_a = py::none(), "region"_a = py::none(), "region_names"_a = std::vector<std::string>());
  type.def_property_readonly(
      "points",
      [](const FrozenPointer& m) {
        return view(m, m->points.empty() ? nullptr : &m->points.front().x,
                    {static_cast<py::ssize_t>(m->points.size()), 2});
      },
      "Coordinates of shape (n, 2), in chords.");
  type.def_property_readonly(
      "triangles",
      [](const FrozenPointer& m) {
        return view(m, m->triangles.empty() ? nullptr : m->triangles.front().data(),
                    {static_cast<py::ssize_t>(m->triangles.size()), 3});
      },
      "Point indices of shape (m, 3), counter-clockwise.");
  type.def_property_readonly(
      "quads",
      [](const FrozenPointer& m) {
        return view(m, m->quads.empty() ? nullptr : m->quads.front().data(),
                    {static_cast<py::ssize_t>(m->quads.size()), 4});
      },
      "Quadrilaterals: point indices of shape (q, 4), counter-clockwise.");
  type.def_property_readonly(
      "boundaries", [](const FrozenPointer& m) { return boundaries(m); },
      "By name: pairs of point indices of shape (k, 2), the domain on their left.");
  type.def(
      "with_points", &with_points, "points"_a,
      "The same mesh with its points at other places, of shape (n, 2): connectivity, keys and boundaries "
      "are the same. check() says whether it is valid there.");
  add_columns(type);
  type.def(
      "save",
      [](const FrozenPointer& mesh, const std::filesystem::path& file, const py::dict& fields) {
        const std::vector<Field> all = fields_from(fields, *mesh);
        py::gil_scoped_release released;
        write_mesh(*mesh, file, WriteOptions{.fields = all});
      },
      "file"_a, "fields"_a = py::dict(),
      "Writes .vtkhdf, .vtu, .msh or .su2, with fields on points or triangles by name.");
  type.def(
      "draw",
      [](const FrozenPointer& mesh, const std::filesystem::path& file,
         const std::optional<std::array<double, 4>>& window, int width) {
        py::gil_scoped_release released;
        draw(*mesh, file, {.window = window, .width = width});
      },
      "file"_a, py::kw_only(), "window"_a = py::none(), "width"_a = 1600,
      "Writes a picture, .svg or .png. window: x0, y0, x1, y1.");
  type.def(py::pickle(
      [](const FrozenPointer& mesh) { return py::tuple(packed_mesh(mesh)); },
      [](const py::tuple& state) { return std::const_pointer_cast<FrozenMesh>(unpacked_mesh(state)); }));
  type.def("__repr__", [](const FrozenMesh& m) {
    return "FrozenMesh(" + std::to_string(m.points.size()) + " points, " +
           std::to_string(m.triangles.size()) + " triangles)";
  });
  add_check(module);
  module.def(
      "read_frozen",
      [](const std::filesystem::path& file) {
        py::gil_scoped_release released;
        return std::make_shared<FrozenMesh>(read_frozen_mesh(file));
      },
      "file"_a, "Reads the arrays of a .vtkhdf, .vtu, .msh or .su2 file. Raises FileError, FormatError.");
  module.def(
      "read_fields",
      [](const std::filesystem::path& file) {
        py::dict result;
        for (const Field& field : read_fields(file)) {
          py::array_t<double> values = copied(field.values);
          if (field.components > 1) values = values.reshape({py::ssize_t{-1}, py::ssize_t{field.components}});
          result[py::str(field.name)] = values;
        }
        return result;
      },
      "file"_a, "The fields of a mesh file, by name.");
}

Snapshot snapshot_of(const py::object& mesh) {
  if (py::isinstance<FrozenMesh>(mesh)) return mesh.cast<FrozenPointer>();
  if (py::isinstance<LivingMesh>(mesh)) return mesh.cast<LivingMeshPointer>()->snapshot();
  if (py::isinstance<StepRecord>(mesh)) return after_step(mesh.cast<const StepRecord&>());
  if (const Snapshot layered = layered_snapshot(mesh)) return layered;
  if (const Snapshot layered = after_layered_step(mesh)) return layered;
  throw py::type_error("mesh: found " + type_of(mesh) +
                       ", expected a Mesh, a LayeredMesh, a FrozenMesh or a Step");
}

}  // namespace remodel::python
