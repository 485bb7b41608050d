#pragma once

#include <string>

#include "remodel/error.h"

namespace remodel {

// Throws Error (argument) unless what is expected of an option's value holds.
inline void require_option(bool holds, const char* option, double found, const char* expected) {
  if (!holds)
    throw Error(ErrorCode::argument, option, "found " + std::to_string(found) + ", expected " + expected);
}

}  // namespace remodel
