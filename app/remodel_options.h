#pragma once

// The options of remodelling that `update`, `batch` and `optimise` share, and those of a single step.

#include <functional>
#include <string>

#include "remodel/remodel.h"

namespace CLI {
class App;
}

namespace remodel::app {

void add_remodel_options(CLI::App& app, RemodelOptions& options);
// Throws Error (argument) for --keep and --delaunay-slack where the strategy has no use for them. `imported`: whether
// `mesh` is one of another program's, whose length scales are never renewed.
void require_used(const std::function<bool(const std::string&)>& given, Strategy strategy, bool imported,
                  const std::string& mesh);
// --strategy of a single step: chain, renew, morph or reference.
void add_step_strategy(CLI::App& app, RemodelOptions& options);

}  // namespace remodel::app
