// LayeredMesh: layers on walls, for flows with friction.

#include "remodel/layers.h"

#include <cmath>
#include <optional>

#include "apart.h"
#include "living_layers.h"
#include "pickles.h"
#include "remodel/check.h"
#include "remodel/flow_layer.h"
#include "remodel/generate.h"
#include "remodel/io.h"

namespace remodel::python {
namespace {

// The native state, for pickles: a mesh that was pickled goes on to the same bytes.
py::dict layered_dict(const LayeredState& state) {
  return py::dict("outer"_a = python::dict_of(state.outer), "walls"_a = domain_to_json(state.walls),
                  "first_height"_a = state.options.first_height, "growth"_a = state.options.growth,
                  "thickness"_a = state.options.thickness, "names"_a = state.options.walls,
                  "fan_from_deg"_a = state.options.fan_from_deg, "levels"_a = state.levels,
                  "fans"_a = state.fans, "columns"_a = state.columns, "next_column"_a = state.next_column);
}

LayeredState layered_state_of(const py::dict& dict) {
  LayeredState state;
  const auto read = [&](const char* key, auto& member) {
    read_member(dict, key,
                [&](const py::handle& object) { member = object.cast<std::decay_t<decltype(member)>>(); });
  };
  py::dict outer;
  std::string walls;
  read("outer", outer), read("walls", walls);
  state.outer = python::state_of(outer), state.walls = domain_from_json(walls, "pickle");
  read("first_height", state.options.first_height), read("growth", state.options.growth);
  read("thickness", state.options.thickness), read("names", state.options.walls);
  read("fan_from_deg", state.options.fan_from_deg), read("levels", state.levels);
  read("fans", state.fans), read("columns", state.columns), read("next_column", state.next_column);
  return state;
}

FlowModel friction_named(const std::string& model) {
  if (model == "laminar") return FlowModel::laminar;
  if (model == "sa") return FlowModel::sa;
  throw Error(ErrorCode::argument, "model", "found '" + model + "', expected 'laminar' or 'sa'");
}

LayersPointer layers_generated(const py::object& shape, const std::optional<double>& reynolds,
                               const std::string& model, const std::optional<double>& first_height,
                               const std::optional<double>& thickness, double growth,
                               const std::vector<std::string>& walls, double spacing, double gradation,
                               double farfield_radius, int farfield_points, std::uint32_t max_vertices,
                               const std::optional<double>& wake, double wake_angle,
                               const std::optional<double>& reference_length) {
  LayerOptions layer = layer_of(reynolds, model, first_height, thickness, growth, walls);
  const WallSpacing stations = wall_spacing(spacing);
  ShapesDomain given =
      domain_of(shape, {.farfield_radius = farfield_radius, .farfield_points = farfield_points});
  Domain& domain = given.domain;
  const double chord = reference_length.value_or(given.chord);
  if (!(chord > 0.0 && std::isfinite(chord)))
    throw Error(ErrorCode::argument, "reference_length", "expected more than 0");
  layer.first_height *= chord, layer.thickness *= chord;
  if (given.in_farfield) space_walls(domain, stations.times(chord));
  if (auto line = wake_line(wake, wake_angle)) {
    line->length *= chord, line->first *= chord, line->most *= chord;
    add_wake(domain, *line, layer);
  }
  LayeredGenerateResult result = interruptible([&](StepObserver& observer) {
    return generate_layered(domain, layer, {.gradation = gradation, .max_vertices = max_vertices}, &observer);
  });
  if (result.stopped != Stopped::done)
    throw Error(
        ErrorCode::argument, "max_vertices",
        std::string("the mesh is unfinished (") + name_of(result.stopped) + "), expected a whole one");
  return layers_alive(std::move(result.mesh));
}

CheckResult layers_checked(LivingLayers& mesh) {
  const Snapshot frozen = mesh.snapshot();
  CheckOptions options;
  {
    const ThreadLock::Held held(mesh.lock);
    const Mesh& outer = mesh.mesh.outer();
    options = {.min_angle_deg = outer.options().min_angle_deg,
               .delaunay = !outer.shows_file_triangles(),
               .delaunay_slack_deg = outer.delaunay_slack_deg()};
  }
  return Apart().run(std::make_shared<Stop>(), [frozen, options] { return check(*frozen, options); });
}

struct LayersWay {
  LayeredMeshDerivative derivative;
  std::size_t first = 0, count = 0;  // the airfoil's coefficients, upper then lower
};

LayersWay layers_way(const LivingLayers& living, const std::string& boundary, const std::string& interior) {
  const LayeredMesh& mesh = living.mesh;
  if (interior != "own" && interior != "still")
    throw Error(ErrorCode::argument, "interior", "found '" + interior + "', expected own or still");
  const auto [loop, first, count] = airfoil_numbers(mesh.domain(), boundary);
  if (interior == "own" && own_strategy(mesh.outer(), living.follows) == Strategy::reference)
    return {LayeredMeshDerivative(mesh, moving_loops(mesh.outer(), {loop})), first, count};
  return {LayeredMeshDerivative(mesh), first, count};
}

py::array layers_jvp(LivingLayers& mesh, const Reals& direction, const std::string& boundary,
                     const std::string& interior) {
  const std::vector<double> given = reals(direction, "direction");
  const ThreadLock::Held held(mesh.lock);
  const LayersWay way = layers_way(mesh, boundary, interior);
  if (given.size() != way.count)
    throw Error(ErrorCode::argument, "direction",
                "found " + std::to_string(given.size()) + " numbers, expected " + std::to_string(way.count));
  std::vector<double> all(way.derivative.coefficients(), 0.0);
  std::copy(given.begin(), given.end(), all.begin() + static_cast<std::ptrdiff_t>(way.first));
  return view_of(way.derivative.jvp(all));
}

py::array_t<double> layers_vjp(LivingLayers& mesh, const py::object& by_points, const std::string& boundary,
                               const std::string& interior) {
  const std::vector<Point> weights = points(array_of(by_points, "by_points"), "by_points");
  const ThreadLock::Held held(mesh.lock);
  const LayersWay way = layers_way(mesh, boundary, interior);
  const std::vector<double> all = way.derivative.vjp(weights);
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(way.first);
  return copied(std::vector<double>(first, first + static_cast<std::ptrdiff_t>(way.count)));
}

void add_layered_mesh(py::module_& module) {
  py::class_<LivingLayers, LayersPointer> type(
      module, "LayeredMesh",
      R"(A living mesh with layers of flat quadrilaterals on its walls, for flows with friction. Made by
generate_layered() or LayeredMesh.load(); changed by update(), which keeps the layer's connectivity for a whole run.
solve_flow() and LivingFlow.solve() take it. It has the arrays, pictures and bridges of a Mesh: points of the layer come
first, column by column.)");
  type.def(
      "freeze", [](LivingLayers& mesh) { return std::const_pointer_cast<FrozenMesh>(mesh.snapshot()); },
      "The mesh as it is now: read-only arrays, points of the layer first.");
  add_layered_steps(type);
  type.def("jvp", &layers_jvp, "direction"_a, "boundary"_a = "", py::kw_only(), "interior"_a = "own",
           R"(How the points of freeze() move, of shape (n, 2), with an airfoil's coefficients in a direction
(Airfoil.design's order), at fixed connectivity. interior: as vjp()'s.)");
  type.def(
      "vjp", &layers_vjp, "by_points"_a, "boundary"_a = "", py::kw_only(), "interior"_a = "own",
      R"(Derivatives by the points of freeze(), of shape (n, 2), become derivatives by an airfoil's coefficients
(Airfoil.design's order), at fixed connectivity: walls move with their curves, the layer with its columns. The rest of the
interior stays ('still'), or goes as the last step would ('own'): along after update(strategy='reference'), otherwise it
stays. LivingFlow.gradients() has derivatives by points.)");
  type.def("check", &layers_checked,
           "Validates it: cells convex, conforming and counter-clockwise, the outer mesh as promised.");
  type.def("copy", [](LivingLayers& mesh) {
    const ThreadLock::Held held(mesh.lock);
    return layers_alive(mesh.mesh, mesh.follows);
  });
  type.def(
      "save",
      [](LivingLayers& mesh, const std::filesystem::path& file) {
        const ThreadLock::Held held(mesh.lock);
        py::gil_scoped_release released;
        write_mesh(mesh.mesh, file);
      },
      "file"_a, "Writes it by the file's suffix; .vtkhdf is native: load() goes on from it, to the bit.");
  type.def_static(
      "load",
      [](const std::filesystem::path& file) {
        py::gil_scoped_release released;
        const KeptPipes once;
        if (!holds_layers(file))
          throw Error(ErrorCode::format, file.string(),
                      "found no layers, expected a native mesh with them: Mesh.load() reads others");
        return layers_alive(read_layered_mesh(file));
      },
      "file"_a, "A native file (.vtkhdf) of a layered mesh. Raises FileError and FormatError.");
  type.def(py::pickle(
      [](LivingLayers& mesh) {
        const ThreadLock::Held held(mesh.lock);
        py::dict state = layered_dict(mesh.mesh.state());
        state["follows"] = mesh.follows;
        return state;
      },
      [](const py::dict& state) {
        bool follows = false;
        read_member(state, "follows", [&](const py::handle& object) { follows = object.cast<bool>(); });
        return layers_alive(LayeredMesh::restore(layered_state_of(state), "pickle"), follows);
      }));
  const auto figure = [&](const char* name, auto read, const char* doc) {
    type.def_property_readonly(
        name,
        [read](LivingLayers& mesh) {
          const ThreadLock::Held held(mesh.lock);
          return read(mesh.mesh);
        },
        doc);
  };
  figure(
      "domain", [](const LayeredMesh& m) { return m.domain(); }, "The present walls, a copy.");
  figure(
      "cells", [](const LayeredMesh& m) { return m.cells(); }, "How many cells it has: layer and outside.");
  figure(
      "layer_cells", [](const LayeredMesh& m) { return m.layer_cells(); },
      "How many of them are of the layer.");
  figure(
      "columns", [](const LayeredMesh& m) { return m.columns(); }, "Stations with a column of cells.");
  figure(
      "levels", [](const LayeredMesh& m) { return m.levels(); }, "Cells of a column.");
  figure(
      "shrunk", [](const LayeredMesh& m) { return m.shrunk(); }, "Columns that had to give way.");
  figure(
      "held", [](const LayeredMesh& m) { return m.outer().held(); },
      "Whether the outer mesh is the morph of a reference mesh (update(strategy='reference')).");
  figure(
      "delaunay_slack", [](const LayeredMesh& m) { return m.outer().delaunay_slack_deg(); },
      "By how much the angles opposite an inner edge outside may exceed 180 degrees; 0: Delaunay.");
  figure(
      "min_angle", [](const LayeredMesh& m) { return m.outer().statistics().min_angle_deg; },
      "The smallest angle outside the layer, in degrees.");
  figure(
      "steps", [](const LayeredMesh& m) { return m.outer().step(); },
      "How many steps the mesh has lived through.");
  figure(
      "gradation", [](const LayeredMesh& m) { return m.outer().options().gradation; }, "As generate()'s.");
  type.def("__len__", [](LivingLayers& mesh) {
    const ThreadLock::Held held(mesh.lock);
    return mesh.mesh.cells();
  });
  type.def("__repr__", [](LivingLayers& mesh) {
    const ThreadLock::Held held(mesh.lock);
    return "LayeredMesh(" + std::to_string(mesh.mesh.cells()) + " cells, step " +
           std::to_string(mesh.mesh.outer().step()) + ")";
  });
  figure(
      "first_height", [](const LayeredMesh& m) { return m.options().first_height; },
      "The height of the cells at the wall, in chords.");
  figure(
      "thickness", [](const LayeredMesh& m) { return m.options().thickness; },
      "The wanted thickness of the layer, in chords.");
}

}  // namespace

LayersPointer layers_alive(LayeredMesh mesh, bool follows) {
  auto living = std::make_shared<LivingLayers>();
  living->mesh = std::move(mesh);
  living->follows = follows;
  return living;
}

LayerOptions layer_of(const std::optional<double>& reynolds, const std::string& model,
                      const std::optional<double>& first_height, const std::optional<double>& thickness,
                      double growth, const std::vector<std::string>& walls) {
  if (!reynolds && (!first_height || !thickness))
    throw Error(ErrorCode::argument, "reynolds", "not given, expected it, or first_height and thickness");
  LayerOptions layer;
  if (reynolds) layer = layer_for_flow(friction_named(model), *reynolds);
  if (first_height) layer.first_height = *first_height;
  if (thickness) layer.thickness = *thickness;
  layer.growth = growth, layer.walls = walls;
  return layer;
}

WallSpacing wall_spacing(double factor) {
  if (!(factor > 0.0)) throw Error(ErrorCode::argument, "spacing", "expected more than 0");
  return WallSpacing{}.times(factor);
}

std::optional<WakeLine> wake_line(const std::optional<double>& length, double angle_deg) {
  if (!(std::abs(angle_deg) <= 90.0))
    throw Error(ErrorCode::argument, "wake_angle",
                "found " + std::to_string(angle_deg) + ", expected -90 to 90");
  if (!length && angle_deg != 0.0)
    throw Error(ErrorCode::argument, "wake_angle", "given without wake, expected both");
  if (!length) return std::nullopt;
  return wake_at(*length, angle_deg);
}

Snapshot layered_snapshot(const py::object& mesh) {
  if (!py::isinstance<LivingLayers>(mesh)) return nullptr;
  return mesh.cast<LayersPointer>()->snapshot();
}

void add_layers(py::module_& module) {
  add_layered_changes(module);
  add_layered_mesh(module);
  const LayerOptions usual;
  module.def(
      "generate_layered", &layers_generated, "shape"_a, py::kw_only(), "reynolds"_a = py::none(),
      "model"_a = "sa", "first_height"_a = py::none(), "thickness"_a = py::none(), "growth"_a = usual.growth,
      "walls"_a = std::vector<std::string>(), "spacing"_a = 1.0, "gradation"_a = 8.0,
      "farfield_radius"_a = 25.0, "farfield_points"_a = 50, "max_vertices"_a = QualityOptions{}.max_vertices,
      "wake"_a = py::none(), "wake_angle"_a = 0.0, "reference_length"_a = py::none(),
      R"(A mesh with layers on its walls, of a Domain or around an Airfoil (or the name or file of one).

reynolds: of a chord; it gives heights and thickness for the model, 'laminar' (the first cell a 500th of 5 / sqrt(Re)) or
'sa' (y+ 1 on a flat plate, a 150th of that at most).
first_height and thickness, in chords, are given instead or besides. growth: of a cell's height over that of the cell
below, 1.02 to 2. walls: names of the walls that get a layer (unless given all holes, and of an outer loop that has an
inlet, outlet or symmetry plane all else); they may end at such openings. spacing: the distances between
stations over the usual ones (0.0015 chords at both edges, 0.008 at most); a Domain has its own stations. gradation: as
generate()'s. wake: the length of a line of fine triangles behind the trailing edge, in chords, and wake_angle its angle
in degrees; updates leave it where it is. reference_length: the chord that all of these are by, in units of the domain,
as solve_flow() has it: 1 unless given, of files in their own coordinates the longest chord. docs/layers.md has what to choose. Raises ArgumentError and GeometryError; Ctrl-C ends it.)");
}

}  // namespace remodel::python
