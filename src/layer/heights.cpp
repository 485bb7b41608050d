#include "layer/heights.h"

#include <algorithm>
#include <cmath>

#include "generate/require_option.h"
#include "remodel/layers.h"

namespace remodel {

namespace {

constexpr std::uint32_t most_levels = 1000;

// The n-th root of x >= 1, by Newton's method from above, where it descends on the convex x^n.
double positive_root(double x, int n) {
  int exponent = 0;
  std::frexp(x, &exponent);
  double root = std::ldexp(1.0, exponent / n + 1);
  for (int i = 0; i < 100; ++i) {
    double power = 1.0;
    for (int k = 1; k < n; ++k) power *= root;
    const double next = root - (root - x / power) / n;
    if (!(next < root)) break;
    root = next;
  }
  return root;
}

void require_reynolds(double reynolds) {
  require_option(reynolds >= 1.0 && reynolds <= 1e12, "Reynolds number", reynolds, "1 to 1e12");
}

}  // namespace

double first_height(double y_plus, double reynolds) {
  require_option(y_plus > 0.0 && std::isfinite(y_plus), "y+", y_plus, "more than 0");
  require_reynolds(reynolds);
  const double friction = 0.026 / positive_root(reynolds, 7);
  return y_plus / (reynolds * std::sqrt(0.5 * friction));
}

double boundary_layer_thickness(double reynolds) {
  require_reynolds(reynolds);
  return 0.37 / positive_root(reynolds, 5);
}

double thickness_of(double first_height, double growth, int count) {
  require_option(count >= 1 && count <= static_cast<int>(most_levels), "number of layers", count, "1 to 1000");
  return first_height * geometric_sum(growth, static_cast<std::uint32_t>(count));
}

double geometric_sum(double ratio, std::uint32_t count) {
  double sum = 0.0;
  for (std::uint32_t j = 0; j < count; ++j) sum = sum * ratio + 1.0;
  return sum;
}

std::uint32_t level_count(double first, double growth, double thickness) {
  // A thickness that was made of a number of cells gives that number, whatever the last bits are.
  const double wanted = thickness / first * (1.0 - 1e-9);
  double sum = 1.0;
  std::uint32_t count = 1;
  for (; sum < wanted && count < most_levels; ++count) sum = sum * growth + 1.0;
  return count;
}

// The sum is convex and grows with the ratio: Newton's method descends to the root from any ratio above it.
double growth_of(double first, double growth, double thickness, std::uint32_t count) {
  const double wanted = thickness / first;
  if (count < 2 || wanted <= static_cast<double>(count)) return 1.0;
  double ratio = growth;
  for (int i = 0; i < 100; ++i) {
    double sum = 0.0, slope = 0.0;
    for (std::uint32_t j = 0; j < count; ++j) {
      slope = slope * ratio + sum;
      sum = sum * ratio + 1.0;
    }
    const double next = ratio - (sum - wanted) / slope;
    if (!(next < ratio)) break;
    ratio = next;
  }
  return std::max(ratio, 1.0);
}

void level_heights(double first, double ratio, double thickness, std::span<double> heights) {
  const double count = static_cast<double>(heights.size());
  const double lowest = thickness < first * count ? thickness / count : first;
  double sum = 0.0, height = lowest;
  for (double& level : heights) {
    sum += height;
    level = sum;
    height *= ratio;
  }
  heights.back() = thickness;
}

}  // namespace remodel
