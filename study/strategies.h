#pragma once

// The strategies that a study can replay with; the only place that lists them.

#include <string>

#include "remodel/optimise.h"

namespace remodel {

// Sets the options of the named strategy. Throws Error (argument) for an unknown name.
void set_strategy(const std::string& name, OptimiseOptions& options);

}  // namespace remodel
