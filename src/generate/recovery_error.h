#pragma once

#include <stdexcept>

namespace remodel {

// A boundary could not be brought into a triangulation: its curves cross at a finer scale than its initial
// discretisation shows, or the splits that would resolve it exceed their limits. Remodelling answers by
// rolling back and generating afresh; generation reports the design as one that cannot be meshed.
struct RecoveryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace remodel
