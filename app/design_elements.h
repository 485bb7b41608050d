#pragma once

// The elements of a design problem (docs/design.md).

#include "design_keys.h"
#include "element_space.h"

namespace remodel::app {

// The array `elements` of the problem. Throws Error (format) naming the file and the key.
ElementSpace read_elements(const Keys& problem, const std::string& file, int degree,
                           const AirfoilDomainOptions& options);

}  // namespace remodel::app
