#pragma once

#include <span>

namespace remodel {

// Class function times Bernstein polynomials of degree row.size() - 1 at x, where rest is 1 - x, computed by
// the caller without cancellation where that matters.
void cst_row(double x, double rest, double e1, double e2, std::span<double> row);

}  // namespace remodel
