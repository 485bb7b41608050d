#include "optimise_start.h"

#include "arguments.h"
#include "number_text.h"
#include "remodel/error.h"
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
  options.given = [&app](const std::string& name) { return given(app, name); };
}

OptimiseStart read_start(const OptimiseStartOptions& options, const MeshingOptions& meshing,
                         OptimiseOptions& run) {
  require_one_start(options);
  if (!options.mesh.empty()) return read_mesh_start(options, meshing, run);
  run.domain = meshing.discretisation;
  run.quality = meshing.resolved_quality();
  OptimiseStart start;
  start.from = fit_shape(options.from, meshing.fit, start.fits).airfoil;
  return start;
}

Json meshing_json(const MeshingOptions& meshing, const OptimiseOptions& run) {
  if (!run.start) return to_json(meshing);
  const QualityOptions& quality = run.start->mesh.options();
  return {{"points", run.start->place.parameters.size()},
          {"gradation", quality.gradation},
          {"resolution", quality.resolution},
          {"min_angle_deg", quality.min_angle_deg},
          {"refine_angle_deg", quality.refine_angle_deg},
          {"max_gradation", quality.max_gradation},
          {"cst_degree", meshing.fit.degree},
          {"close_trailing_edge", meshing.fit.close_trailing_edge},
          {"max_vertices", quality.max_vertices}};
}

void add_start_figures(Report& report, const OptimiseStartOptions& options, const OptimiseStart& start) {
  if (!start.file) return report.figure("from", "from", options.from);
  report.figure("mesh", "mesh", options.mesh);
  if (!options.start.boundary.empty()) report.figure("boundary", "boundary", options.start.boundary);
  add_import_figures(report, *start.file);
  report.data("fit", {{"max_error", start.fit.max_error}, {"rms_error", start.fit.rms_error}});
  report.line("fit of its airfoil", "largest error " + short_text(start.fit.max_error) + ", rms " +
                                        short_text(start.fit.rms_error) + " chords");
  const RemodelResult& first = start.first;
  report.data("start", {{"triangles_before", first.triangles_before},
                        {"triangles", first.triangles},
                        {"preserved", first.preserved},
                        {"preserved_percent", first.preserved_percent()},
                        {"regenerated", first.regenerated}});
  report.line("remodelled to the fit", std::to_string(first.preserved) + " of " +
                                           std::to_string(first.triangles_before) + " triangles kept");
}

}  // namespace remodel::app
