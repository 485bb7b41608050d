#pragma once

// The one place that knows which strategies a study can replay with.

#include <string>

#include "remodel/remodel.h"

namespace remodel {

Strategy strategy_named(const std::string& name);  // throws Error (argument)

}  // namespace remodel
