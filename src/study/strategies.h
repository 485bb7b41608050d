#pragma once

// The one place that knows which strategies a study can replay with.

#include <string>

#include "remodel/optimise.h"

namespace remodel {

// Sets what the strategy of that name is made of. Throws Error (argument) for a name that is none.
void set_strategy(const std::string& name, OptimiseOptions& options);

}  // namespace remodel
