// remodel mesh SHAPE [-o MESH]...: a fresh quality mesh.

#include <map>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "meshing_options.h"
#include "outputs.h"
#include "remodel/generate.h"
#include "timing.h"

namespace remodel::app {
namespace {

struct MeshCommand {
  std::string shape;
  MeshingOptions meshing;
  MeshOutputs outputs;
  int repeat = 1;
  bool json = false;
};

Status run(const MeshCommand& command) {
  command.outputs.require_possible();
  const CstAirfoil airfoil = load_airfoil(command.shape, command.meshing.cst_degree);
  const Domain domain = airfoil_domain(airfoil, command.meshing.discretisation);
  const QualityOptions quality = command.meshing.resolved_quality();

  GenerateResult result;
  std::vector<double> seconds;
  for (int i = 0; i < command.repeat; ++i) {
    const Stopwatch watch;
    GenerateResult generated = generate(domain, quality);
    seconds.push_back(watch.seconds());
    result = std::move(generated);
  }
  command.outputs.write(result.mesh);

  Report report;
  report.figure("shape", "shape", command.shape);
  describe(report, command.meshing);
  add_mesh_figures(report, result.mesh.freeze(), result.mesh.statistics());
  add_gradation_error(report, result.mesh.gradation_error());
  report.figure("exempt_triangles", "exempt triangles", result.exempt_triangles,
                "(below the angle bound at a small input angle)");
  report.figure("seconds", command.repeat > 1 ? "generation, median" : "generation", median(seconds),
                "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return result.stopped == Stopped::done ? Status::done : Status::limit;
}

}  // namespace

void add_mesh_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App& app = add_subcommand(program, "mesh", "Generates a quality mesh around an airfoil",
                                 [command, &action] { action = [command] { return run(*command); }; });
  add_shape_argument(app, command->shape);
  command->outputs.add_options(app, Presence::optional);
  add_meshing_options(app, command->meshing);
  add_repeat(app, command->repeat);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
