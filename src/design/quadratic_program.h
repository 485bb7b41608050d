#pragma once

// Small convex quadratic programs by a primal-dual interior-point method. Source: J. Nocedal and S. J.
// Wright, "Numerical Optimization", 2nd ed. (2006), section 16.6, with Mehrotra's predictor and corrector.

#include <vector>

namespace remodel {

// x' H x / 2 + g' x is to be small where A x <= b and low <= x <= high.
struct QuadraticProgram {
  std::vector<double> h;               // H row by row: symmetric, with no negative eigenvalue
  std::vector<double> g;               // of each variable
  std::vector<std::vector<double>> a;  // the rows of A
  std::vector<double> b;
  std::vector<double> low, high;  // finite
};

struct QuadraticSolution {
  std::vector<double> x;
  std::vector<double> multipliers;  // of the rows of A, 0 or more: H x + g + A' multipliers is what bounds hold
};

// The solution to about ten digits of the largest variable's range. There has to be a point that satisfies
// all constraints; otherwise x is between the bounds and nothing more is known of it.
QuadraticSolution solved(const QuadraticProgram& program);

}  // namespace remodel
