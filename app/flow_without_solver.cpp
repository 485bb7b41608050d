// The program remodel-mpi has no `live`, `flow`, `polar`, `sweep`, `design`, `film` and `noise`: the
// sequential MUMPS brings a stand-in for MPI that must not meet the real one.

#include "command.h"

namespace remodel::app {

void add_flow_command(CLI::App&, Action&) {}
void add_polar_command(CLI::App&, Action&) {}
void add_sweep_command(CLI::App&, Action&) {}
void add_noise_command(CLI::App&, Action&) {}
void add_design_command(CLI::App&, Action&) {}
void add_film_command(CLI::App&, Action&) {}
void add_live_command(CLI::App&, Action&) {}

}  // namespace remodel::app
