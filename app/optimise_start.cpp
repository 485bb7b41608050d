#include "optimise_start.h"

#include "arguments.h"
#include "layered_update.h"
#include "number_text.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "shape_input.h"

namespace remodel::app {
namespace {

void refuse(const OptimiseStartOptions& options, std::initializer_list<const char*> names, const char* why) {
  for (const char* name : names)
    if (options.given(name)) throw Error(ErrorCode::argument, name, why);
}

void require_one_start(const OptimiseStartOptions& options) {
  if (options.from.empty() && options.mesh.empty())
    throw Error(ErrorCode::argument, "--from", "not given, --from SHAPE or --mesh MESH expected");
  if (!options.from.empty() && !options.mesh.empty())
    throw Error(ErrorCode::argument, "--mesh", "given with --from, one of them expected");
  if (options.mesh.empty())
    refuse(options, {"--boundary", "--refine-angle", "--non-delaunay", "--dissolve-layers"},
           "given without --mesh, expected with it");
  else
    refuse(options,
           {"--farfield-radius", "--farfield-points", "--resolution", "--min-angle", "--max-gradation",
            "--min-edge", "--max-vertices"},
           "given with --mesh, expected with --from: a mesh has its own");
}

constexpr const char* with_layers =
    "given with layers, whose stations are those of --wall-spacing, --te-spacing "
    "and --max-spacing, expected without";

// The mesh's own layers.
OptimiseStart read_layered_start(const OptimiseStartOptions& options, const MeshingOptions& meshing,
                                 OptimiseOptions& run) {
  constexpr const char* has_layers = "given with a mesh that has layers, expected a mesh without";
  refuse(options,
         {"--layers", "--points", "--gradation", "--boundary", "--refine-angle", "--non-delaunay",
          "--dissolve-layers"},
         has_layers);
  const LayeredMesh mesh = read_layered_mesh(options.mesh);
  const std::string name = airfoil_of(mesh.domain(), options.mesh).name;
  MeshStart start{.mesh = mesh.outer(),
                  .place = find_airfoil(mesh.domain(), name, options.mesh),
                  .su2_boxes = boxes_of_layered(options.mesh),
                  .walls = mesh.domain()};
  OptimiseStart result;
  result.fit = fit_airfoil(mesh.domain(), start.place, meshing.fit.degree);
  result.from = result.fit.airfoil;
  LayeredMesh fitted = mesh;
  result.first = remodel(fitted, with_airfoil(mesh.domain(), start.place, result.from), step_options(run));
  result.file.emplace(StartMesh{.mesh = {}, .source = options.mesh, .imported = std::nullopt});
  run.layers = RunLayers{mesh.options(), std::nullopt};
  run.start = std::move(start);
  return result;
}

OptimiseStart read_mesh_start(const OptimiseStartOptions& options, const MeshingOptions& meshing,
                              OptimiseOptions& run) {
  StartMeshOptions wanted = options.start;
  if (options.given("--points")) wanted.points = meshing.discretisation.points;
  wanted.gradation = meshing.gradation;
  StartMesh file = read_start_mesh(options.mesh, wanted);
  MeshStart start{.mesh = file.mesh, .place = place_in(file, wanted), .su2_boxes = file.su2_boxes};
  OptimiseStart result;
  result.fit = fit_airfoil(start.mesh.domain(), start.place, meshing.fit.degree);
  result.from = result.fit.airfoil;
  result.first =
      remodel(start.mesh, with_airfoil(start.mesh.domain(), start.place, result.from), step_options(run));
  run.start = std::move(start);
  result.file = std::move(file);
  return result;
}

Json layers_json(const RunLayers& layers) {
  const LayerOptions& options = layers.options;
  Json json{
      {"first_height", options.first_height}, {"growth", options.growth}, {"thickness", options.thickness}};
  if (layers.spacing)
    json["spacing"] = {{"leading_edge", layers.spacing->leading_edge},
                       {"trailing_edge", layers.spacing->trailing_edge},
                       {"most", layers.spacing->most}};
  if (layers.wake)
    json["wake"] = {{"length", layers.wake->length},
                    {"direction", {layers.wake->direction.x, layers.wake->direction.y}}};
  return json;
}

}  // namespace

void add_optimise_start_options(CLI::App& app, OptimiseStartOptions& options) {
  add_text(app, {"--from", "SHAPE", "", "Airfoil to start from, as for `remodel mesh`; or --mesh"},
           Presence::optional, options.from);
  add_text(app,
           {"--mesh", "MESH", "",
            "Mesh to start from, any readable format: its airfoil is fitted, the rest of it stays; of the "
            "meshing options --points and --gradation apply, its own points and measured if not given"},
           Presence::optional, options.mesh);
  add_start_mesh_options(app, options.start);
  add_layer_options(app, options.layers);
  options.given = [&app](const std::string& name) { return given(app, name); };
}

OptimiseStart read_start(const OptimiseStartOptions& options, const MeshingOptions& meshing,
                         OptimiseOptions& run) {
  require_one_start(options);
  require_consistent(options.layers);
  const bool layered = options.mesh.empty() ? options.layers.layers : holds_layers(options.mesh);
  if (!layered) refuse(options, {"--layer-cells"}, "given without layers, expected with --layers");
  if (layered && !options.given("--strategy")) run.strategy = MeshStrategy::morph;
  if (!options.mesh.empty()) {
    if (layered) return read_layered_start(options, meshing, run);
    refuse(options, {"--layers"}, "given with --mesh, expected with --from, or a mesh that has layers");
    return read_mesh_start(options, meshing, run);
  }
  run.domain = meshing.discretisation;
  MeshingOptions with_gradation = meshing;
  if (layered) {
    refuse(options, {"--points"}, with_layers);
    with_gradation.gradation = meshing.gradation.value_or(gradation_with_layers);
    run.layers =
        RunLayers{resolved(options.layers, 1.0), options.layers.spacing, wake_of(options.layers, 1.0)};
  }
  run.quality = with_gradation.resolved_quality();
  OptimiseStart start;
  start.from = fit_shape(options.from, meshing.fit, start.fits).airfoil;
  return start;
}

Json meshing_json(const MeshingOptions& meshing, const OptimiseOptions& run) {
  if (!run.start) {
    Json json = to_json(meshing);
    json["gradation"] = run.quality.gradation;
    if (run.layers) json.erase("points"), json["layers"] = layers_json(*run.layers);
    return json;
  }
  const QualityOptions& quality = run.start->mesh.options();
  Json json{{"points", run.start->place.parameters.size()},
            {"gradation", quality.gradation},
            {"resolution", quality.resolution},
            {"min_angle_deg", quality.min_angle_deg},
            {"refine_angle_deg", quality.refine_angle_deg},
            {"max_gradation", quality.max_gradation},
            {"cst_degree", meshing.fit.degree},
            {"close_trailing_edge", meshing.fit.close_trailing_edge},
            {"max_vertices", quality.max_vertices}};
  if (run.layers) json["layers"] = layers_json(*run.layers);
  return json;
}

void add_start_figures(Report& report, const OptimiseStartOptions& options, const OptimiseStart& start,
                       bool layered) {
  if (!start.file) return report.figure("from", "from", options.from);
  report.figure("mesh", "mesh", options.mesh);
  if (!options.start.boundary.empty()) report.figure("boundary", "boundary", options.start.boundary);
  add_import_figures(report, *start.file);
  report.data("fit", {{"max_error", start.fit.max_error}, {"rms_error", start.fit.rms_error}});
  report.line("fit of its airfoil", "largest error " + short_text(start.fit.max_error) + ", rms " +
                                        short_text(start.fit.rms_error) + " chords");
  const RemodelResult& first = start.first;
  const std::string cells = layered ? "cells" : "triangles";
  report.data("start", {{cells + "_before", first.triangles_before},
                        {cells, first.triangles},
                        {"preserved", first.preserved},
                        {"preserved_percent", first.preserved_percent()},
                        {"regenerated", first.regenerated}});
  report.line("remodelled to the fit", std::to_string(first.preserved) + " of " +
                                           std::to_string(first.triangles_before) + " " + cells + " kept");
}

}  // namespace remodel::app
