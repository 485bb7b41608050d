#pragma once

// The gap between two sections.

#include <cstddef>
#include <vector>

#include "remodel/domain.h"

namespace remodel {

// The least distance between the polygons of two loops that lie apart, and its derivatives by the numbers of
// the domain (coefficients_of(Domain)), at fixed parameters: those of the two places that are nearest to each
// other (J. M. Danskin, SIAM J. Appl. Math. 14, 1966). Where that pair changes, the derivative jumps.
struct Gap {
  double distance = 0.0;
  std::vector<double> by_numbers;
};
Gap gap_between(const Domain& domain, std::size_t loop, std::size_t other);

}  // namespace remodel
