#pragma once

// The options of remodelling that `update`, `batch` and `optimise` share, and those of a single step.

#include "remodel/remodel.h"

namespace CLI {
class App;
}

namespace remodel::app {

void add_remodel_options(CLI::App& app, RemodelOptions& options);
// --strategy of a single step: chain, renew, morph or reference.
void add_step_strategy(CLI::App& app, RemodelOptions& options);

}  // namespace remodel::app
