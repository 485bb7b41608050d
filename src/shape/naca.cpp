// NACA 4- and 5-digit sections, modified ones too. Source: E. N. Jacobs, K. E. Ward, R. M. Pinkerton, NACA
// report 460, 1933; E. N. Jacobs, R. M. Pinkerton, NACA report 537, 1935 (the 5-digit mean lines); C. L.
// Ladson, C. W. Brooks, NASA TM X-3284, 1975 (the table of constants; the modified thickness, whose trailing
// edge is open by a fiftieth of the largest).

#include <algorithm>
#include <cmath>

#include "airfoil_rows.h"
#include "naca_parts.h"
#include "remodel/error.h"
#include "turn.h"

namespace remodel {
namespace {

constexpr int stations_a_side = 200;

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

// Of a modified section: the radius of the nose, in sixths of the ordinary one, and where the thickness is
// largest, in tenths of the chord.
struct Modification {
  int radius = 0, place = 0;
};

// Half of it over the thickness, from the largest one forward and backward.
class ModifiedThickness {
 public:
  explicit ModifiedThickness(Modification m) : place_(0.1 * m.place) {
    // The slope at the trailing edge, by the place of the largest thickness.
    constexpr double slopes[] = {1.000, 1.170, 1.575, 2.325, 3.500};
    constexpr double edge = 0.002,
                     half = 0.1 - edge;  // at the trailing edge, and the largest over that, of 20 %
    const double t = place_, u = 1.0 - t, d1 = 0.2 * slopes[m.place - 2];
    const double bend = (6.0 * half - 2.0 * d1 * u) / (u * u);
    rear_[0] = edge;
    rear_[1] = d1;
    rear_[2] = (3.0 * half - 2.0 * d1 * u) / (u * u);
    rear_[3] = (-2.0 * half + d1 * u) / (u * u * u);
    // 9 stands for three times the ordinary radius.
    front_[0] = 0.2969 * (m.radius == 9 ? std::sqrt(3.0) : m.radius / 6.0);
    const double root = std::sqrt(t);
    constexpr double top = 0.1;
    front_[1] = 3.0 * top / t - 15.0 / 8.0 * front_[0] / root - 0.5 * bend * t;
    front_[2] = -3.0 * top / (t * t) + 1.25 * front_[0] / (t * root) + bend;
    front_[3] = top / (t * t * t) - 0.375 * front_[0] / (t * t * root) - 0.5 * bend / t;
  }
  double operator()(double x, double thickness) const {
    const double e = 1.0 - x;
    const double sum = x > place_
                           ? rear_[0] + e * (rear_[1] + e * (rear_[2] + e * rear_[3]))
                           : front_[0] * std::sqrt(x) + x * (front_[1] + x * (front_[2] + x * front_[3]));
    return 5.0 * thickness * sum;
  }

 private:
  double place_, front_[4], rear_[4];
};

bool all_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<Modification> modification_of(std::string_view designation, std::string_view suffix) {
  if (suffix.empty()) return std::nullopt;
  const Modification result{.radius = suffix[0] - '0', .place = suffix[1] - '0'};
  if (result.place < 2 || result.place > 6)
    refuse_naca(designation, "a modification with the largest thickness at 2 to 6 tenths of the chord");
  if (result.radius == 0)
    refuse_naca(designation, "a modification with a round nose: 1 to 9 behind the dash");
  return result;
}

}  // namespace

void refuse_naca(std::string_view designation, const std::string& expected) {
  throw Error(ErrorCode::argument, "NACA section",
              "found \"" + std::string(designation.substr(0, 40)) + "\", expected " + expected);
}

std::optional<NacaParts> digit_section(std::string_view designation) {
  const std::size_t dash = designation.find('-');
  const std::string_view digits = designation.substr(0, dash);
  const std::string_view suffix = dash == designation.npos ? "" : designation.substr(dash + 1);
  if ((digits.size() != 4 && digits.size() != 5) || !all_digits(digits) || !all_digits(suffix) ||
      (dash != designation.npos && suffix.size() != 2))
    return std::nullopt;
  std::vector<int> digit;
  for (const char c : digits) digit.push_back(c - '0');
  const double thickness = 0.01 * (10 * digit[digit.size() - 2] + digit.back());
  const std::optional<MeanLineFunction> camber = mean_line(digit);
  if (thickness == 0.0 || !camber) return std::nullopt;
  NacaParts parts{.half_thickness = {}, .mean_line = *camber};
  const std::optional<Modification> modified = modification_of(designation, suffix);
  for (int i = 0; i <= stations_a_side; ++i) {
    const double x = 0.5 * (1.0 - direction(0.5 * i / stations_a_side).x);
    parts.half_thickness.push_back(
        {x, modified ? ModifiedThickness(*modified)(x, thickness) : half_thickness(x, thickness)});
  }
  return parts;
}

AirfoilCoordinates naca_airfoil(std::string_view designation) {
  std::optional<NacaParts> parts = digit_section(designation);
  if (!parts) parts = six_series_section(designation);
  if (!parts)
    refuse_naca(
        designation,
        "4 digits such as 2412 or 5 digits such as 23012 or 23112, modified ones such as 0012-64, or the "
        "6-series such as 63-206, 65(1)-412, 64A010 or 63-206 a=.8");
  std::vector<AirfoilRow> outline;
  const auto add = [&](Point p, double sign) {
    const MeanLine line = parts->mean_line(p.x);
    const double offset = sign * p.y / std::hypot(1.0, line.slope);
    outline.push_back({.point = {p.x - offset * line.slope, line.y + offset}});
  };
  const std::vector<Point>& points = parts->half_thickness;
  for (std::size_t i = points.size(); i-- > 1;) add(points[i], 1.0);
  for (const Point p : points) add(p, -1.0);
  const std::string name = "NACA " + std::string(designation);
  return surfaces_of_outline(name, outline, name);
}

}  // namespace remodel
