#pragma once

// The options that `update` and `optimise` share: how the mesh is remodelled.

#include "remodel/remodel.h"

namespace CLI {
class App;
}

namespace remodel::app {

void add_remodel_options(CLI::App& app, RemodelOptions& options);

}  // namespace remodel::app
