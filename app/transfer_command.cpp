// remodel transfer OLD NEW [-o MESH]... [--state FILE --state-out FILE]: what a solver knew on one mesh, on
// another.

#include <memory>

#include "arguments.h"
#include "carry.h"
#include "command.h"
#include "figures.h"
#include "mesh_input.h"
#include "outputs.h"
#include "remodel/error.h"

namespace remodel::app {
namespace {

struct TransferCommand {
  std::string before, after;
  MeshOutputs outputs;
  CarryOptions carry;
  bool json = false;
};

Status run(const TransferCommand& command) {
  command.outputs.require_possible();
  if (command.outputs.files().empty() && command.carry.state_out.empty())
    throw Error(ErrorCode::argument, "transfer", "found nothing to write, expected -o or --state-out");
  const FrozenMesh before = read_any_mesh(command.before).frozen;
  const MeshInput after = read_any_mesh(command.after);
  Cargo cargo(command.before, before, command.carry);
  if (cargo.empty())
    throw Error(ErrorCode::argument, command.before, "found no fields, expected some, or a state by --state");
  cargo.carry(before, after.frozen);
  write_with_fields(command.outputs, after, cargo.fields());
  cargo.write_state(after.frozen);

  Report report;
  report.figure("from", "from", command.before);
  report.figure("to", "to", command.after);
  cargo.add_figures(report);
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_transfer_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<TransferCommand>();
  CLI::App& app = add_command(program, "transfer",
                              "Carries fields and a solver's state from one mesh to another of its history",
                              command, action);
  add_text(app, {"old", "OLD", "", "Mesh that the values are on, of any format"}, Presence::required,
           command->before);
  add_text(app, {"new", "NEW", "", "Mesh that they are carried to"}, Presence::required, command->after);
  command->outputs.add_options(app, Presence::optional);
  add_carry_options(app, command->carry);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
