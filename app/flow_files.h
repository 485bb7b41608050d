#pragma once

// The files of a flow, and what is said of them and of its conditions on standard error.

#include <string>
#include <utility>
#include <vector>

#include "outputs.h"
#include "remodel/flow.h"

namespace remodel::app {

// Throws Error (argument) where two outputs are one file: those of -o and these, each by its option; empty
// names are none.
void require_different_files(const MeshOutputs& outputs,
                             const std::vector<std::pair<std::string, std::string>>& others);
// Formats of the mesh alone have no flow.
void say_flow_left_out(const MeshOutputs& outputs);
// Says so below Mach 0.1, where the scheme is inaccurate: docs/flow.md has figures, under "Slow streams".
void warn_of_slow_stream(const FlowConditions& conditions);

}  // namespace remodel::app
