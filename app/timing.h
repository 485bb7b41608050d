#pragma once

#include <vector>

#include "base/stopwatch.h"

namespace remodel::app {

// The mean of the two middle values where their number is even. values is not empty.
double median(std::vector<double> values);

}  // namespace remodel::app
