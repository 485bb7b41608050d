#pragma once

// The files of a flow, and what is said of them and of it on standard error.

#include <string>
#include <utility>
#include <vector>

#include "outputs.h"

namespace remodel::app {

// Throws Error (argument) where two outputs are one file: those of -o and these, each by its option; empty
// names are none.
void require_different_files(const MeshOutputs& outputs,
                             const std::vector<std::pair<std::string, std::string>>& others);
// Formats of the mesh alone have no flow.
void say_flow_left_out(const MeshOutputs& outputs);
// A line each on standard error.
void print_warnings(const std::string& source, const std::vector<std::string>& warnings);

}  // namespace remodel::app
