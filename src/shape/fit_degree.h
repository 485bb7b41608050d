#pragma once

// The degrees that sections are fitted with, and that names of sections take.

#include <string>

#include "remodel/error.h"

namespace remodel {

inline constexpr int lowest_degree = 2, highest_degree = 12;

inline void require_fit_degree(int degree) {
  if (degree < lowest_degree || degree > highest_degree)
    throw Error(ErrorCode::argument, "CST degree", "found " + std::to_string(degree) + ", expected 2 to 12");
}

}  // namespace remodel
