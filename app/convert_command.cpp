// remodel convert MESH -o MESH...: the same mesh in other formats.

#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "mesh_input.h"
#include "outputs.h"

namespace remodel::app {
namespace {

struct ConvertCommand {
  std::string mesh;
  MeshOutputs outputs;
  bool json = false;
};

Status run(const ConvertCommand& command) {
  command.outputs.require_possible();
  const MeshInput input = read_any_mesh(command.mesh);
  // A native copy of a native mesh keeps its state.
  if (input.living) {
    command.outputs.write(*input.living);
  } else {
    command.outputs.write(input.frozen);
  }
  Report report;
  report.figure("mesh", "mesh", command.mesh);
  report.figure("triangles", "triangles", input.frozen.triangles.size());
  report.figure("vertices", "vertices", input.frozen.points.size());
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_convert_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App& app = add_subcommand(program, "convert", "Writes a mesh in other formats",
                                 [command, &action] { action = [command] { return run(*command); }; });
  add_mesh_argument(app, command->mesh);
  command->outputs.add_options(app, Presence::required);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
