#pragma once

#include <stdexcept>

namespace remodel {

// A boundary could not be brought into a triangulation: its curves cross at a finer scale than its initial
// discretisation shows, or the splits that would resolve it exceed their limits. Remodelling answers by
// rolling back and generating afresh; generation reports the design as one that cannot be meshed.
struct RecoveryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What it says where loops call one part of the plane by two names.
inline constexpr const char* contradicting_sides =
    "the loops lie on the wrong sides of each other: a part of the plane is called domain by one and outside "
    "by "
    "another, or the boundary is not closed";

}  // namespace remodel
