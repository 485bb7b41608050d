// remodel mesh SHAPE... [-o MESH]...: a fresh quality mesh.

#include <functional>
#include <limits>
#include <map>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "domain_input.h"
#include "figures.h"
#include "flow_mesh.h"
#include "interrupt.h"
#include "layer_options.h"
#include "meshing_options.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/limits.h"
#include "timing.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct MeshCommand {
  DomainInputOptions shapes;
  MeshingOptions meshing;
  LayerChoice layers;
  MeshOutputs outputs;
  int repeat = 1;
  bool json = false;
  std::function<bool(const std::string&)> given;  // on the command line
};

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Of a mesh that was interrupted: there was no time to measure it.
void add_counts(Report& report, const MeshCounts& counts) {
  report.figure("triangles", "triangles", counts.triangles);
  report.figure("vertices", "vertices", counts.vertices);
  add_boundary_figures(report, counts.boundary);
  report.figure("steiner_boundary_vertices", "Steiner vertices on the boundary",
                counts.steiner_boundary_vertices);
  for (const char* key : {"min_angle_deg", "exempt_triangles", "max_radius_edge", "max_gradation"})
    report.data(key, nullptr);
}

void report_input(Report& report, const MeshCommand& command, const ShapesDomain& input) {
  for (const std::string& shape : command.shapes.shapes) report.line("shape", shape);
  report.data("shape", command.shapes.shapes.size() == 1 ? Json(command.shapes.shapes[0])
                                                         : Json(command.shapes.shapes));
  add_findings(report, input);
}

// The stations of airfoils are those of the layer's spacings; a domain file has its own, unless spacings are
// given.
void space_input(const MeshCommand& command, ShapesDomain& input) {
  refuse_given(command.given, {"--points", "--turning-share"},
               "given with --layers, expected --wall-spacing, --te-spacing and --max-spacing, which set the "
               "stations");
  if (!input.in_farfield && !command.layers.spacing_given) return;
  validate_input(command.shapes, input.domain);
  space_walls(input.domain, command.layers.spacing.times(input.chord), command.layers.walls);
}

Status run_layers(const MeshCommand& command) {
  MeshingOptions meshing = command.meshing;
  meshing.gradation = meshing.gradation.value_or(gradation_with_layers);
  ShapesDomain input = read_domain(command.shapes, meshing.discretisation, meshing.fit);
  require_used(input, command.given);
  space_input(command, input);
  const LayerOptions layers = resolved(command.layers, input.chord);
  add_wake_line(command.layers, input.chord, layers, input.domain);

  InterruptObserver observer;
  LayeredGenerateResult result;
  std::vector<double> seconds;
  for (int i = 0; i < command.repeat && result.stopped != Stopped::interrupted; ++i) {
    const Stopwatch watch;
    LayeredGenerateResult generated =
        generate_layered(input.domain, layers, meshing.resolved_quality(), &observer);
    seconds.push_back(watch.seconds());
    result = std::move(generated);
  }
  const LayeredMesh& mesh = result.mesh;
  command.outputs.write(mesh, command.layers.cells);

  Report report;
  report_input(report, command, input);
  describe(report, meshing, input.in_farfield, false);
  const FrozenMesh view = mesh.freeze(command.layers.cells);
  add_cell_counts(report, view.triangles.size(), view.quads.size());
  report.figure("vertices", "vertices", view.points.size());
  std::map<std::string, std::size_t> boundary;
  for (const FrozenBoundary& part : view.boundaries) boundary[part.name] += part.edges.size();
  add_boundary_figures(report, boundary);
  add_layer_figures(report, mesh);
  const MeshStatistics outside = mesh.outer().statistics();
  report.figure("min_angle_deg", "smallest angle outside the layer", outside.min_angle_deg, "degrees");
  add_exemption_figures(report, outside.exempt_triangles, outside.min_held_angle_deg);
  report.figure("max_gradation", "largest r / (H mean LS) outside", outside.max_gradation);
  report.figure("seconds", command.repeat > 1 ? "generation, median" : "generation", median(seconds),
                "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  warn_of_limit(result.stopped, mesh.outer());
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return result.stopped == Stopped::done ? Status::done : Status::limit;
}

Status run(const MeshCommand& command) {
  command.outputs.require_possible();
  require_consistent(command.layers);
  if (command.layers.layers) return run_layers(command);
  refuse_given(command.given, {"--layer-cells"}, "given without --layers, expected both");
  const ShapesDomain input = read_domain(command.shapes, command.meshing.discretisation, command.meshing.fit);
  require_used(input, command.given);
  const QualityOptions quality = command.meshing.resolved_quality();

  InterruptObserver observer;
  GenerateResult result;
  std::vector<double> seconds;
  for (int i = 0; i < command.repeat && result.stopped != Stopped::interrupted; ++i) {
    const Stopwatch watch;
    GenerateResult generated = generate_input(command.shapes, input.domain, quality, &observer);
    seconds.push_back(watch.seconds());
    result = std::move(generated);
  }
  command.outputs.write(result.mesh);

  Report report;
  report_input(report, command, input);
  describe(report, command.meshing, input.in_farfield, input.outlines.empty());
  const bool interrupted = result.stopped == Stopped::interrupted;
  if (interrupted)
    add_counts(report, counts_of(result.mesh));
  else
    add_mesh_figures(report, result.mesh.freeze(), result.mesh.statistics());
  report.figure("small_angles", "input angles below 60 degrees", result.small_angles);
  add_gradation_error(report,
                      interrupted ? GradationError{none, none} : result.mesh.gradation_error(&observer));
  report.figure("seconds", command.repeat > 1 ? "generation, median" : "generation", median(seconds),
                "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  warn_of_limit(result.stopped, result.mesh);
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return result.stopped == Stopped::done ? Status::done : Status::limit;
}

}  // namespace

void add_mesh_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App& app = add_command(program, "mesh", "Generates a quality mesh around airfoils, or of any domain",
                              command, action);
  add_domain_input(app, command->shapes);
  command->outputs.add_options(app, Presence::optional);
  add_meshing_options(app, command->meshing);
  add_turning_share(app, command->meshing.discretisation);
  add_layer_options(app, command->layers);
  command->given = [&app](const std::string& name) { return given(app, name); };
  add_real(
      app,
      {"--refine-angle", "DEGREES", "the angle of --min-angle",
       "Angle in degrees that refinement works to, 0 to 34, where it is more than the one promised: 32 for a "
       "mesh that `update --strategy reference` is to hold"},
      {.low = 0.0, .high = 34.0}, command->meshing.quality.refine_angle_deg);
  add_repeat(app, command->repeat);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
