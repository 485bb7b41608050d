#pragma once

#include "command.h"

namespace remodel::app {

// `remodel study report`: a subcommand of `study`.
void add_study_report_command(CLI::App& study, Action& action);

}  // namespace remodel::app
