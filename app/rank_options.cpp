#include "arguments.h"
#include "ranks.h"

namespace remodel::app {

void add_rank_option(CLI::App& app, RanksOptions& options) {
  add_real(app,
           {"--rank-timeout", "SECONDS", "60", "Silence after which an MPI rank counts as lost: 1 to 86400"},
           {.low = 1.0, .high = 86400.0}, options.timeout);
}

}  // namespace remodel::app
