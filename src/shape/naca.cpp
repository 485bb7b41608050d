// NACA 4- and 5-digit sections. Source: E. N. Jacobs, K. E. Ward, R. M. Pinkerton, NACA report 460, 1933;
// E. N. Jacobs, R. M. Pinkerton, NACA report 537, 1935 (the 5-digit mean lines); C. L. Ladson, C. W. Brooks,
// NASA TM X-3284, 1975 (the table of constants).

#include <cmath>
#include <functional>
#include <optional>

#include "airfoil_rows.h"
#include "remodel/error.h"
#include "turn.h"

namespace remodel {
namespace {

constexpr int stations_a_side = 200;

struct MeanLine {
  double y = 0.0;
  double slope = 0.0;
};
using MeanLineFunction = std::function<MeanLine(double)>;

[[noreturn]] void refuse(std::string_view digits) {
  throw Error(ErrorCode::argument, "NACA section",
              "found \"" + std::string(digits.substr(0, 40)) +
                  "\", expected 4 digits such as 2412 or 5 digits such as 23012 or 23112");
}

// Half the thickness; the last coefficient is the one that closes the trailing edge.
double half_thickness(double x, double thickness) {
  const double sum = 0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 + x * -0.1036)));
  return x == 1.0 ? 0.0 : 5.0 * thickness * sum;
}

MeanLineFunction four_digit_mean_line(double m, double p) {
  return [m, p](double x) -> MeanLine {
    if (m == 0.0) return {};
    const double side = x < p ? p : 1.0 - p;
    const double scale = m / (side * side);
    const double y = x < p ? scale * x * (2.0 * p - x) : scale * (1.0 - 2.0 * p + x * (2.0 * p - x));
    return {y, 2.0 * scale * (p - x)};
  };
}

// For a design lift coefficient of 0.3, by the second digit: where the rear part begins, k1, and k2/k1, which
// is 0 for the lines without reflex.
struct FiveDigitConstants {
  double m, k1, ratio;
};
constexpr FiveDigitConstants plain[] = {{0.0580, 361.400, 0.0},
                                        {0.1260, 51.640, 0.0},
                                        {0.2025, 15.957, 0.0},
                                        {0.2900, 6.643, 0.0},
                                        {0.3910, 3.230, 0.0}};
constexpr FiveDigitConstants reflexed[] = {
    {0.1300, 51.990, 0.000764}, {0.2170, 15.793, 0.00677}, {0.3180, 6.520, 0.0303}, {0.4410, 3.191, 0.1355}};

MeanLineFunction five_digit_mean_line(const FiveDigitConstants& c, double lift, bool reflex) {
  const double m = c.m;
  const double scale = c.k1 / 6.0 * (lift / 0.3);
  if (!reflex) {
    return [m, scale](double x) -> MeanLine {
      if (x >= m) return {scale * m * m * m * (1.0 - x), -scale * m * m * m};
      return {scale * x * (x * (x - 3.0 * m) + m * m * (3.0 - m)),
              scale * (3.0 * x * (x - 2.0 * m) + m * m * (3.0 - m))};
    };
  }
  const double ratio = c.ratio;
  return [m, scale, ratio](double x) -> MeanLine {
    const double cubic = x < m ? 1.0 : ratio;
    const double d = x - m;
    const double linear = ratio * (1.0 - m) * (1.0 - m) * (1.0 - m) + m * m * m;
    return {scale * (cubic * d * d * d - linear * x + m * m * m), scale * (3.0 * cubic * d * d - linear)};
  };
}

std::optional<MeanLineFunction> mean_line(const std::vector<int>& digit) {
  if (digit.size() == 4) {
    if ((digit[0] == 0) != (digit[1] == 0)) return std::nullopt;  // a camber without a place, or the reverse
    return four_digit_mean_line(0.01 * digit[0], 0.1 * digit[1]);
  }
  const bool reflex = digit[2] == 1;
  const int first = reflex ? 2 : 1;
  if (digit[0] == 0 || digit[2] > 1 || digit[1] < first || digit[1] > 5) return std::nullopt;
  const FiveDigitConstants* table = reflex ? reflexed : plain;
  return five_digit_mean_line(table[digit[1] - first], 0.15 * digit[0], reflex);
}

}  // namespace

AirfoilCoordinates naca_airfoil(std::string_view digits) {
  std::vector<int> digit;
  for (const char c : digits.substr(0, 6)) {
    if (c < '0' || c > '9') refuse(digits);
    digit.push_back(c - '0');
  }
  if (digit.size() != 4 && digit.size() != 5) refuse(digits);
  const double thickness = 0.01 * (10 * digit[digit.size() - 2] + digit.back());
  const std::optional<MeanLineFunction> camber = mean_line(digit);
  if (thickness == 0.0 || !camber) refuse(digits);

  std::vector<AirfoilRow> outline;
  for (int i = -stations_a_side; i <= stations_a_side; ++i) {
    const double x = 0.5 * (1.0 - direction(0.5 * std::abs(i) / stations_a_side).x);
    const MeanLine line = (*camber)(x);
    const double offset = (i < 0 ? 1.0 : -1.0) * half_thickness(x, thickness) / std::hypot(1.0, line.slope);
    outline.push_back({.point = {x - offset * line.slope, line.y + offset}});
  }
  return surfaces_of_outline("NACA " + std::string(digits), outline, "NACA " + std::string(digits));
}

}  // namespace remodel
