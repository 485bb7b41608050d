#pragma once

#include <string>

#include "remodel/history.h"

namespace remodel {

// What of a row that was read is outside of the range that it is written in: "worker: found 0, expected 1 or
// more". Empty where all is within. What is missing (NaN) is within.
std::string out_of_range(const EvaluationRecord& record);

}  // namespace remodel
