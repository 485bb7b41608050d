// FrozenMesh: a mesh as read-only arrays, its validation, files and pictures.

#include "apart.h"
#include "bindings.h"
#include "living.h"
#include "remodel/check.h"
#include "remodel/draw.h"
#include "remodel/io.h"

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
  type.def_property_readonly("region", [](const FrozenPointer& m) { return view(m, m->region); });
  type.def_readonly("region_names", &FrozenMesh::region_names);
}

std::vector<Field> fields_from(const py::dict& fields, const FrozenMesh& mesh) {
  std::vector<Field> result;
  for (const auto& [key, value] : fields) {
    const auto values = value.cast<Reals>();
    if (values.ndim() != 1 && values.ndim() != 2)
      throw Error(ErrorCode::argument, key.cast<std::string>(),
                  "expected values of shape (n,) or (n, components)");
    Field field{.name = key.cast<std::string>(),
                .components = values.ndim() == 2 ? static_cast<int>(values.shape(1)) : 1,
                .values = {}};
    const auto count = static_cast<std::size_t>(values.shape(0));
    if (count != mesh.points.size() && count == mesh.triangles.size()) field.place = FieldPlace::triangles;
    field.values.assign(values.data(), values.data() + values.size());
    result.push_back(std::move(field));
  }
  return result;
}

FrozenPointer from_arrays(
    const Reals& coordinates,
    const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>& triangles,
    const py::dict& named) {
  auto mesh = std::make_shared<FrozenMesh>();
  mesh->points = points(coordinates, "points");
  const auto index = [&](std::int64_t value, const char* what) {
    if (value < 0 || value >= static_cast<std::int64_t>(mesh->points.size()))
      throw Error(ErrorCode::argument, what,
                  "found point " + std::to_string(value) + ", expected 0 to " +
                      std::to_string(mesh->points.size()) + " - 1");
    return static_cast<std::uint32_t>(value);
  };
  if (triangles.ndim() != 2 || triangles.shape(1) != 3)
    throw Error(ErrorCode::argument, "triangles", "expected an array of shape (m, 3)");
  for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
    mesh->triangles.push_back({index(*triangles.data(i, 0), "triangles"),
                               index(*triangles.data(i, 1), "triangles"),
                               index(*triangles.data(i, 2), "triangles")});
  for (const auto& [name, value] : named) {
    const auto edges = value.cast<py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>>();
    if (edges.ndim() != 2 || edges.shape(1) != 2)
      throw Error(ErrorCode::argument, name.cast<std::string>(), "expected an array of shape (k, 2)");
    FrozenBoundary boundary{.name = name.cast<std::string>(), .edges = {}};
    for (py::ssize_t i = 0; i < edges.shape(0); ++i)
      boundary.edges.push_back(
          {index(*edges.data(i, 0), "boundaries"), index(*edges.data(i, 1), "boundaries")});
    mesh->boundaries.push_back(std::move(boundary));
  }
  return mesh;
}

void add_check(py::module_& module) {
  py::class_<Violation>(module, "Violation", "A broken rule, with the points or triangles concerned.")
      .def_readonly("rule", &Violation::rule)
      .def_readonly("ids", &Violation::ids)
      .def_readonly("detail", &Violation::detail)
      .def("__repr__", [](const Violation& v) { return "Violation(" + v.rule + ": " + v.detail + ")"; });
  py::class_<CheckResult>(module, "CheckResult",
                          "The verdict of the independent validator, which works in rational arithmetic.")
      .def_readonly("valid", &CheckResult::valid)
      .def_readonly("violations", &CheckResult::violations)
      .def_readonly("triangles", &CheckResult::triangles)
      .def_readonly("vertices", &CheckResult::vertices)
      .def_readonly("min_angle_deg", &CheckResult::min_angle_deg)
      .def_readonly("max_gradation", &CheckResult::max_gradation)
      .def_readonly("delaunay", &CheckResult::delaunay)
      .def_readonly("boundary", &CheckResult::boundary)
      .def_readonly("area", &CheckResult::area)
      .def("__bool__", [](const CheckResult& r) { return r.valid; })
      .def("__repr__", [](const CheckResult& r) {
        return std::string("CheckResult(valid=") + (r.valid ? "True" : "False") +
               ", triangles=" + std::to_string(r.triangles) + ")";
      });
  module.def(
      "check",
      [](const py::object& mesh, double min_angle, double max_gradation, bool delaunay) {
        const Snapshot frozen = snapshot_of(mesh);
        const CheckOptions options{
            .min_angle_deg = min_angle, .max_gradation = max_gradation, .delaunay = delaunay};
        return Apart().run(std::make_shared<Stop>(), [frozen, options] { return check(*frozen, options); });
      },
      "mesh"_a, py::kw_only(), "min_angle"_a = 0.0, "max_gradation"_a = 0.0, "delaunay"_a = true,
      "Validates a Mesh or FrozenMesh of any origin. min_angle is in degrees; 0 tests no bound.");
}

}  // namespace

void add_snapshots(py::module_& module) {
  py::class_<FrozenMesh, FrozenPointer> type(
      module, "FrozenMesh",
      R"(A mesh as read-only numpy arrays, at one moment of its life. Arrays are views: they are not
copied, and they stay valid whatever happens to the living mesh.

FrozenMesh(points, triangles, boundaries) takes the arrays of another program; import_mesh() brings it to life.)");
  type.def(py::init(&from_arrays), "points"_a, "triangles"_a, "boundaries"_a = py::dict());
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
      "boundaries", [](const FrozenPointer& m) { return boundaries(m); },
      "By name: pairs of point indices of shape (k, 2), the domain on their left.");
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
  if (py::isinstance<LivingMesh>(mesh)) {
    return mesh.cast<LivingMeshPointer>()->snapshot();
  }
  throw py::type_error("expected a Mesh or a FrozenMesh");
}

}  // namespace remodel::python
