#include "turn.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace remodel {

double fold(double t) {
  const double rest = 1.0 - t;
  return t > 0.5 ? rest : 1.0 - rest;  // the second subtraction is exact (Sterbenz): rest is in [1/2, 1]
}

// The Taylor series: the first term left out is below (pi/4)^21 / 21! = 1.3e-22.
double sin_half_turns(double u) {
  assert(u >= 0.0 && u <= 0.25);
  const double v = std::numbers::pi * u;
  const double z = v * v;
  double sum = -1.0 / 121645100408832000.0;  // 1/19!
  sum = sum * z + 1.0 / 355687428096000.0;   // 1/17!
  sum = sum * z - 1.0 / 1307674368000.0;     // 1/15!
  sum = sum * z + 1.0 / 6227020800.0;        // 1/13!
  sum = sum * z - 1.0 / 39916800.0;          // 1/11!
  sum = sum * z + 1.0 / 362880.0;            // 1/9!
  sum = sum * z - 1.0 / 5040.0;              // 1/7!
  sum = sum * z + 1.0 / 120.0;               // 1/5!
  sum = sum * z - 1.0 / 6.0;                 // 1/3!
  return v + v * (sum * z);
}

namespace {

// cos(pi u) for u in [0, 1/4], by the half angle.
double cos_half_turns(double u) {
  const double half = sin_half_turns(0.5 * u);
  return 1.0 - 2.0 * half * half;
}

}  // namespace

Point direction(double turns) {
  const double fraction = turns - std::floor(turns);
  const double a = 2.0 * fold(fraction);  // the angle to the positive x axis in half turns, in [0, 1]
  const double side = fraction > 0.5 ? -1.0 : 1.0;
  if (a <= 0.25) return {cos_half_turns(a), side * sin_half_turns(a)};
  if (a < 0.75) {
    const double x = a <= 0.5 ? sin_half_turns(0.5 - a) : -sin_half_turns(a - 0.5);
    return {x, side * cos_half_turns(std::abs(a - 0.5))};
  }
  return {-cos_half_turns(1.0 - a), side * sin_half_turns(1.0 - a)};
}

}  // namespace remodel
