#pragma once

// A section with more or fewer coefficients.

#include "remodel/airfoil.h"

namespace remodel {

// The result is the same airfoil with shape functions of a higher degree: exact but for rounding.
CstAirfoil raise_degree(const CstAirfoil& airfoil, int degree);
// The section with surfaces of that degree. A higher one than its own is raise_degree(); one of a lower
// degree is the nearest in the least squares of its height, at the same exponents and trailing edges. Throws
// Error (argument) for a degree that is not 1 to 50.
CstAirfoil with_degree(const CstAirfoil& airfoil, int degree);

}  // namespace remodel
