#pragma once

#include <string>

#include "geometry/place_text.h"
#include "remodel/error.h"

namespace remodel {

// Throws Error (argument) unless what is expected of an option's value holds.
inline void require_option(bool holds, const char* option, double found, const char* expected) {
  if (!holds)
    throw Error(ErrorCode::argument, option, "found " + exact_text(found) + ", expected " + expected);
}

}  // namespace remodel
