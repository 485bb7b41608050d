// remodel mesh SHAPE... [-o MESH]...: a fresh quality mesh.

#include <map>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "domain_input.h"
#include "figures.h"
#include "interrupt.h"
#include "meshing_options.h"
#include "outputs.h"
#include "timing.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct MeshCommand {
  DomainInputOptions shapes;
  MeshingOptions meshing;
  MeshOutputs outputs;
  int repeat = 1;
  bool json = false;
};

Status run(const MeshCommand& command) {
  command.outputs.require_possible();
  const DomainInput input = read_domain(command.shapes, command.meshing.discretisation, command.meshing.fit);
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
  for (const std::string& shape : command.shapes.shapes) report.line("shape", shape);
  report.data("shape", command.shapes.shapes.size() == 1 ? Json(command.shapes.shapes[0])
                                                         : Json(command.shapes.shapes));
  add_findings(report, input);
  describe(report, command.meshing, input.in_farfield, input.outlines.empty());
  add_mesh_figures(report, result.mesh.freeze(), result.mesh.statistics());
  report.figure("small_angles", "input angles below 60 degrees", result.small_angles);
  add_gradation_error(report, result.mesh.gradation_error(&observer));
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
