#pragma once

// Noise of values along a line of designs: what is left of them when a smooth function is taken away, and
// what that makes of finite differences.

#include <cstddef>
#include <span>
#include <vector>

namespace remodel {

// A polynomial of least squares through values at places along a line.
struct LineFit {
  double rms = 0.0;          // of the residuals, over the degrees of freedom that are left
  double slope = 0.0;        // at 0
  double slope_error = 0.0;  // standard deviation of the slope, if the residuals are independent
  // The step of central differences at 0 with the least error, of noise over the step and of the third
  // derivative times its square, and that error. 0 where there is no noise, or the degree is below 3.
  double step = 0.0;
  double step_error = 0.0;
  std::vector<double> residuals;  // in the order of the values
};

// Throws Error (argument) for a degree below 1, fewer than degree + 2 values, places that are not different,
// and numbers that are not finite.
LineFit fit_line(std::span<const double> places, std::span<const double> values, int degree);

}  // namespace remodel
