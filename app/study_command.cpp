// remodel study: the paper's study. So far its report alone.

#include "arguments.h"
#include "command.h"

namespace remodel::app {

void add_study_command(CLI::App& program, Action& action) {
  CLI::App& app = add_subcommand(program, "study", "Reports on a study", [] {});
  add_study_report_command(app, action);
}

}  // namespace remodel::app
