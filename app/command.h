#pragma once

// The registration and the exit statuses of all subcommands.

#include <functional>
#include <memory>
#include <string>

#include "arguments.h"

namespace remodel::app {

// The program's exit statuses: part of its contract.
enum class Status : int {
  done = 0,
  answer_is_no = 1,   // done, and a mesh is invalid or a design crosses itself
  bad_input = 2,      // bad usage or bad input; nothing was written
  limit = 3,          // stopped at a limit or by an interrupt; what is finished is kept
  internal_error = 4  // our own bug
};

// The work of the chosen subcommand: set while the command line is parsed, called afterwards.
using Action = std::function<Status()>;

// Registers a subcommand whose options fill `command`, a shared one that its options may refer to.
// run(*command) is its work.
template <class Command>
CLI::App& add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::shared_ptr<Command>& command, Action& action) {
  return add_subcommand(program, name, description,
                        [command, &action] { action = [command] { return run(*command); }; });
}

// Each function registers one subcommand, which sets `action` when it is chosen; it is in <name>_command.cpp.
void add_mesh_command(CLI::App& program, Action& action);
void add_update_command(CLI::App& program, Action& action);
void add_batch_command(CLI::App& program, Action& action);
void add_check_command(CLI::App& program, Action& action);
void add_fit_command(CLI::App& program, Action& action);
void add_flow_command(CLI::App& program, Action& action);
void add_optimise_command(CLI::App& program, Action& action);
void add_design_command(CLI::App& program, Action& action);
void add_draw_command(CLI::App& program, Action& action);
void add_film_command(CLI::App& program, Action& action);
void add_polar_command(CLI::App& program, Action& action);
void add_sweep_command(CLI::App& program, Action& action);
void add_noise_command(CLI::App& program, Action& action);
void add_transfer_command(CLI::App& program, Action& action);
void add_live_command(CLI::App& program, Action& action);
void add_convert_command(CLI::App& program, Action& action);
void add_shapes_command(CLI::App& program, Action& action);
void add_soak_command(CLI::App& program, Action& action);
void add_study_command(CLI::App& program, Action& action);  // with REMODEL_STUDY

}  // namespace remodel::app
