#pragma once

// The file of a design problem: docs/design.md describes it.

#include <string>

#include "remodel/design_problem.h"

namespace remodel::app {

// Throws Error naming the file and the place in it.
DesignProblem read_design_problem(const std::string& file);

}  // namespace remodel::app
