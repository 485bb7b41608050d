#pragma once

// Flows with friction behind the door of flow.cpp.

#include <string>

#include "remodel/flow.h"

namespace remodel::flow {

// Of a model with friction. Throws Error (argument) as solve_flow() does.
FlowResult friction_flow(const FrozenMesh& mesh, const FlowConditions& conditions, const FlowOptions& options,
                         const std::string& source);

}  // namespace remodel::flow
