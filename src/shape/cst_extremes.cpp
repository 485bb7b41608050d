// Largest thickness and camber of an airfoil.

#include <algorithm>
#include <cmath>

#include "remodel/airfoil.h"

namespace remodel {
namespace {

constexpr int samples =
    2000;  // of the upper surface; far more than a Bernstein polynomial of use has extremes

// Both surfaces at parameter h in [0, 1/2], where they share x.
struct Section {
  double x = 0.0;
  double upper = 0.0;
  double lower = 0.0;
};

Section section_at(const CstAirfoil& airfoil, double h) {
  const Point upper = airfoil.at(h);
  return {upper.x, upper.y, airfoil.at(1.0 - h).y};
}

// The largest value of a function of a section: the best sample, then golden-section search beside it.
template <typename Value>
Extreme maximum(const CstAirfoil& airfoil, Value value) {
  const auto at = [&](double h) { return value(section_at(airfoil, h)); };
  const double step = 0.5 / samples;
  int best = 0;
  for (int i = 1; i <= samples; ++i) {
    if (at(i * step) > at(best * step)) best = i;
  }
  const double golden = 0.6180339887498949;
  double low = std::max(0.0, (best - 1) * step);
  double high = std::min(0.5, (best + 1) * step);
  while (high - low > 1e-10) {  // below this, rounding decides which of two values is larger
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    (at(a) > at(b) ? high : low) = at(a) > at(b) ? b : a;
  }
  const double refined = 0.5 * (low + high);
  const double h = at(refined) > at(best * step) ? refined : best * step;
  return {.value = at(h), .at = section_at(airfoil, h).x};
}

double camber_of(const Section& s) {
  return 0.5 * (s.upper + s.lower);
}

}  // namespace

Extreme max_thickness(const CstAirfoil& airfoil) {
  return maximum(airfoil, [](const Section& s) { return s.upper - s.lower; });
}

Extreme max_camber(const CstAirfoil& airfoil) {
  const Extreme up = maximum(airfoil, camber_of);
  const Extreme down = maximum(airfoil, [](const Section& s) { return -camber_of(s); });
  if (up.value >= down.value) return up;
  return {.value = -down.value, .at = down.at};
}

}  // namespace remodel
