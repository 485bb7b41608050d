#pragma once

// Names of the numbers that gradients are by.

#include <string>
#include <vector>

#include "remodel/domain.h"

namespace remodel::app {

// Of each of coefficients_of(domain), as problem files of `remodel design` have them: "airfoil.upper[0]",
// "flap.x".
std::vector<std::string> coefficient_names(const Domain& domain);
// Whether that is a coefficient of a section's surface, upper or lower.
bool is_of_section(const std::string& name);

}  // namespace remodel::app
