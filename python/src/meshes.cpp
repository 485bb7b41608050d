// Mesh: generation, import, files, copies and pickles. Its steps are in steps.cpp.

#include "apart.h"
#include "living.h"
#include "pickles.h"
#include "remodel/check.h"
#include "remodel/generate.h"
#include "remodel/import.h"
#include "remodel/io.h"
#include "remodel/limits.h"

namespace remodel::python {
namespace {

LivingMeshPointer alive(Mesh mesh, Stopped stopped = Stopped::done, bool follows = false) {
  auto living = std::make_shared<LivingMesh>();
  living->mesh = std::move(mesh);
  living->stopped = stopped;
  living->follows = follows;
  return living;
}

void warn_of_limit(const GenerateResult& result) {
  if (result.stopped != Stopped::vertex_budget && result.stopped != Stopped::minimum_edge) return;
  const std::string limit = result.stopped == Stopped::vertex_budget
                                ? "max_vertices, " + std::to_string(result.mesh.options().max_vertices) + ","
                                : "the limit on the shortest edge";
  warn({limit + " ended refinement, the mesh is valid but below its quality; triangles are smallest " +
        crowded_place(result.mesh)});
}

LivingMeshPointer generated(const py::object& shape, int points, const std::optional<double>& gradation,
                            double resolution, double min_angle, double max_gradation, double farfield_radius,
                            int farfield_points, std::uint32_t max_vertices, double refine_angle,
                            const std::optional<double>& turning_share) {
  const Domain domain = domain_of(shape, {.points = points,
                                          .farfield_radius = farfield_radius,
                                          .farfield_points = farfield_points,
                                          .turning_share = turning_share})
                            .domain;
  QualityOptions quality{.min_angle_deg = min_angle,
                         .max_gradation = max_gradation,
                         .resolution = resolution,
                         .max_vertices = max_vertices,
                         .refine_angle_deg = refine_angle};
  if (gradation)
    quality.gradation = *gradation;
  else if (!py::isinstance<Domain>(shape))
    quality.gradation = points / 50.0;
  GenerateResult result =
      interruptible([&](StepObserver& observer) { return generate(domain, quality, &observer); });
  warn_of_limit(result);
  return alive(std::move(result.mesh), result.stopped);
}

// Apart: an import does not ask whether to end.
LivingMeshPointer made_alive(const Snapshot& foreign, const std::string& source,
                             const ImportOptions& options) {
  ImportResult result = Apart().run(std::make_shared<Stop>(), [foreign, source, options] {
    return import_mesh(*foreign, source, options);
  });
  return alive(std::move(result.mesh));
}

LivingMeshPointer imported(const py::object& mesh, double refine_angle, double gradation,
                           const std::string& unnamed, bool dissolve_layers) {
  return made_alive(snapshot_of(mesh), "mesh",
                    {.refine_angle_deg = refine_angle,
                     .gradation = gradation,
                     .unnamed = unnamed,
                     .layers = dissolve_layers ? FlatLayers::dissolve : FlatLayers::refuse});
}

LivingMeshPointer loaded(const std::filesystem::path& file) {
  Snapshot foreign;
  {
    py::gil_scoped_release released;
    const KeptPipes once;
    if (holds_layers(file))
      throw Error(ErrorCode::format, file.string(),
                  "found a mesh with layers, expected one without: LayeredMesh.load() reads it");
    try {
      return alive(read_mesh(file));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::argument) throw;
    }
    foreign = std::make_shared<const FrozenMesh>(read_frozen_mesh(file));
  }
  return made_alive(foreign, file.string(), {});
}

LivingMeshPointer copy_of(LivingMesh& mesh) {
  const ThreadLock::Held held(mesh.lock);
  py::gil_scoped_release released;
  return alive(mesh.mesh, mesh.stopped, mesh.follows);
}

CheckResult checked(LivingMesh& mesh) {
  Snapshot frozen;
  std::shared_ptr<const Domain> design;
  CheckOptions options;
  {
    const ThreadLock::Held held(mesh.lock);
    const Mesh& living = mesh.mesh;
    frozen = mesh.freeze();
    design = std::make_shared<const Domain>(living.domain());
    options = {.min_angle_deg = living.options().min_angle_deg,
               .delaunay = !living.shows_file_triangles(),
               .delaunay_slack_deg = living.delaunay_slack_deg(),
               .design = design.get()};
    if (mesh.stopped != Stopped::done)
      options.min_angle_deg = 0.0;
    else
      options.max_gradation = living.promised_gradation();
  }
  return Apart().run(std::make_shared<Stop>(), [frozen, design, options] { return check(*frozen, options); });
}

template <class Read>
auto reading(Read&& read) {
  return [read](LivingMesh& mesh) {
    const ThreadLock::Held held(mesh.lock);
    return read(mesh);
  };
}

void add_figures(py::class_<LivingMesh, LivingMeshPointer>& type) {
  const auto figure = [&](const char* name, auto member, const char* doc) {
    type.def_property_readonly(name, reading([member](LivingMesh& m) { return m.mesh.statistics().*member; }),
                               doc);
  };
  figure("min_angle", &MeshStatistics::min_angle_deg, "The smallest angle, in degrees.");
  figure("max_gradation", &MeshStatistics::max_gradation,
         "The largest circumradius over what the length scales allow: at most 1.");
  figure("steiner_boundary_vertices", &MeshStatistics::steiner_boundary_vertices,
         "Boundary vertices that refinement added.");
  type.def_property_readonly(
      "stopped", [](const LivingMesh& m) { return name_of(m.stopped); },
      "Why generation ended: 'done', or the limit: 'vertex-budget', 'minimum-edge'.");
  type.def_property_readonly("steps", reading([](LivingMesh& m) { return m.mesh.step(); }),
                             "How many steps the mesh has lived through.");
  type.def_property_readonly("domain", reading([](LivingMesh& m) { return m.mesh.domain(); }),
                             "The present domain, a copy.");
  type.def_property_readonly("gradation", reading([](LivingMesh& m) { return m.mesh.options().gradation; }));
  type.def_property_readonly(
      "held", reading([](LivingMesh& m) { return m.mesh.held(); }),
      "Whether it is the morph of a reference mesh (update(strategy='reference')), whose "
      "connectivity it has.");
  type.def_property_readonly(
      "delaunay_slack", reading([](LivingMesh& m) { return m.mesh.delaunay_slack_deg(); }),
      "By how much the angles opposite an inner edge of a held mesh may exceed 180 degrees; 0: Delaunay.");
  type.def("__len__", reading([](LivingMesh& m) { return m.mesh.triangle_count(); }));
  type.def("__repr__", reading([](LivingMesh& m) {
             return "Mesh(" + std::to_string(m.mesh.triangle_count()) + " triangles, step " +
                    std::to_string(m.mesh.step()) + ")";
           }));
}

}  // namespace

void add_meshes(py::module_& module) {
  py::class_<LivingMesh, LivingMeshPointer> type(
      module, "Mesh",
      R"(The living mesh: constrained Delaunay, with bounds on its angles and its gradation, before and
after every call. Made by generate(), import_mesh() or Mesh.load(); changed by update().

Its arrays (points, triangles, ...) are read-only views of the mesh as it is now, made once for a step and kept
alive by whoever holds them. Threads may share a mesh: they take turns. Copies are independent.)");
  type.def(
      "freeze",
      [](const LivingMeshPointer& mesh) {
        return std::const_pointer_cast<FrozenMesh>(snapshot_of(py::cast(mesh)));
      },
      "The arrays of the mesh as it is now.");
  add_figures(type);
  type.def(
      "check", &checked,
      "The independent validator, in rational arithmetic, against the mesh's own bounds and its design.");
  type.def("copy", &copy_of, "An independent mesh with the same state.");
  type.def("__copy__", &copy_of);
  type.def(
      "__deepcopy__", [](LivingMesh& m, const py::dict&) { return copy_of(m); }, "memo"_a);
  type.def(
      "save",
      [](LivingMesh& mesh, const std::filesystem::path& file) {
        const ThreadLock::Held held(mesh.lock);
        py::gil_scoped_release released;
        write_mesh(mesh.mesh, file);
      },
      "file"_a, "Writes .vtkhdf (native: Mesh.load() goes on to the same bytes), .vtu, .msh or .su2.");
  type.def_static("load", &loaded, "file"_a,
                  "Reads a native .vtkhdf mesh, or imports one of another program. Raises FileError, "
                  "FormatError, GeometryError.");
  type.def(py::pickle(
      [](LivingMesh& mesh) {
        const ThreadLock::Held held(mesh.lock);
        return py::make_tuple(dict_of(mesh.mesh.state()), static_cast<int>(mesh.stopped), mesh.follows);
      },
      [](const py::tuple& state) {  // earlier pickles end with the second member
        const bool sound = (state.size() == 2 || state.size() == 3) && py::isinstance<py::dict>(state[0]);
        const int stopped = sound ? state[1].cast<int>() : -1;
        if (stopped < 0 || stopped > static_cast<int>(Stopped::interrupted))
          throw Error(ErrorCode::format, "pickle", "expected the state of a mesh");
        return alive(Mesh::restore(state_of(state[0].cast<py::dict>()), "pickle"),
                     static_cast<Stopped>(stopped), state.size() == 3 && state[2].cast<bool>());
      }));
  module.def(
      "generate", &generated, "shape"_a, py::kw_only(), "points"_a = 200, "gradation"_a = py::none(),
      "resolution"_a = 1.0, "min_angle"_a = 30.0, "max_gradation"_a = QualityOptions{}.max_gradation,
      "farfield_radius"_a = 25.0, "farfield_points"_a = 50, "max_vertices"_a = QualityOptions{}.max_vertices,
      "refine_angle"_a = 0.0, "turning_share"_a = py::none(),
      R"(A mesh of a Domain, or around an Airfoil in a circular far field; shape may also be a name or a file, as
for Domain().

points: vertices on the airfoil, even, 8 to 100000; farfield_radius in chords; turning_share: see Domain(). A
Domain has its own and ignores these. gradation: how slowly triangles grow away from boundaries; points / 50 unless given, 4 for a Domain.
min_angle: degrees, 0 to 34; refine_angle: what refinement works to where it is more, 0 to 34: two degrees more
than min_angle let update(strategy='reference') hold the connectivity longer. Where a limit was reached (max_vertices)
a UserWarning says so, and Mesh.stopped. Sources: J. Ruppert, 1995; J. R. Shewchuk, 2002. Raises ArgumentError and
GeometryError; Ctrl-C ends it.)");
  module.def("import_mesh", &imported, "mesh"_a, py::kw_only(), "refine_angle"_a = 30.0, "gradation"_a = 0.0,
             "unnamed"_a = "boundary", "dissolve_layers"_a = false,
             "Another program's mesh (FrozenMesh) as a living one; its triangles stay until a step comes "
             "near them. dissolve_layers: take one with quadrilaterals, which are split, or with triangles "
             "flatter than 20 to 1 on a wall; steps dissolve such layers. Raises GeometryError.");
}

}  // namespace remodel::python
