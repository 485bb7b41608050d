// NACA 6- and 6A-series sections. Sources: C. L. Ladson, C. W. Brooks, A. S. Hill, D. W. Sproles, "Computer
// Program To Obtain Ordinates for NACA Airfoils", NASA TM 4741, 1996 (a profile of any thickness by scaling
// the functions of its family); I. H. Abbott, A. E. von Doenhoff, "Theory of Wing Sections", 1959, eq. 4-26
// (mean lines); L. K. Loftin, NACA report 903, 1948 (the mean line of the 6A-series).

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "naca_parts.h"
#include "naca_six_tables.h"
#include "remodel/error.h"

namespace remodel {
namespace {

bool is_decimal_digit(char c) {
  return c >= '0' && c <= '9';
}

constexpr int stations = 200;

struct Designation {
  const SixSeriesFamily* family = nullptr;
  bool six_a = false;
  double lift = 0.0, thickness = 0.0;
  double a = 1.0;  // the part of the chord with a uniform load
};

bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

// "(1)", "1" before a dash, ",1": the range of lift with little drag, which is no matter of shape here.
void skip_range(std::string_view& text) {
  if (text.starts_with('(')) {
    const std::size_t end = text.find(')');
    if (end != text.npos) text.remove_prefix(end + 1);
    return;
  }
  if (text.starts_with(',') || text.starts_with('_')) text.remove_prefix(1);
  if (text.size() > 1 && is_decimal_digit(text[0]) && (text[1] == '-' || text[1] == 'A' || text[1] == 'a'))
    text.remove_prefix(1);
}

// " a=.8", in tenths or finer.
std::optional<double> load_of(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == ',')) text.remove_prefix(1);
  if (text.empty()) return 1.0;
  if (!take(text, "a=") && !take(text, "a =")) return std::nullopt;
  std::string number(text);
  std::size_t end = 0;
  double value = -1.0;
  try {
    value = std::stod(number, &end);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (end != number.size() || !(value >= 0.0 && value <= 1.0)) return std::nullopt;
  return value;
}

std::optional<Designation> parsed(std::string_view text) {
  Designation result;
  if (text.size() < 5 || text[0] != '6' || text[1] < '3' || text[1] > '7') return std::nullopt;
  std::string family(text.substr(0, 2));
  text.remove_prefix(2);
  skip_range(text);
  result.six_a = take(text, "A") || (text.size() > 3 && text.find('=') > 4 && take(text, "a"));
  skip_range(text);
  const bool dash = take(text, "-");
  if (!dash && !result.six_a) return std::nullopt;
  if (text.size() < 3 || !std::all_of(text.begin(), text.begin() + 3, is_decimal_digit)) return std::nullopt;
  if (text.size() > 3 && is_decimal_digit(text[3])) return std::nullopt;
  result.lift = 0.1 * (text[0] - '0');
  result.thickness = 0.01 * (10 * (text[1] - '0') + (text[2] - '0'));
  text.remove_prefix(3);
  const std::optional<double> load = load_of(text);
  if (!load) return std::nullopt;
  result.a = *load;
  if (result.six_a) family += 'A';
  for (const SixSeriesFamily& one : six_series)
    if (family == one.name) result.family = &one;
  return result;
}

// The profile whose functions are those of the family times a scale.
std::vector<Point> profile(const SixSeriesFamily& family, double scale) {
  std::vector<std::complex<double>> zeta;
  for (int i = 0; i <= stations; ++i) {
    const double phi = std::numbers::pi * i / stations;
    double psi = 0.0, epsilon = 0.0;
    int n = 0;
    for (const double c : family.psi) psi += c * std::cos(n++ * phi);
    n = 0;
    for (const double c : family.epsilon) epsilon += c * std::sin(++n * phi);
    const std::complex<double> z = std::polar(std::exp(scale * psi), phi - scale * epsilon);
    zeta.push_back(z + 1.0 / z);
  }
  const double chord = std::abs(zeta.back() - zeta.front());
  std::vector<Point> points;
  for (const std::complex<double>& value : zeta) {
    const std::complex<double> p = (zeta.front() - value) / chord;
    points.push_back({p.real(), -p.imag()});
  }
  points.front() = {0.0, 0.0};
  points.back() = {1.0, 0.0};
  return points;
}

double largest(const std::vector<Point>& points) {
  double y = 0.0;
  for (const Point p : points) y = std::max(y, p.y);
  return y;
}

std::vector<Point> profile_of_thickness(const SixSeriesFamily& family, double thickness) {
  double low = 0.0, high = 4.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (2.0 * largest(profile(family, middle)) < thickness ? low : high) = middle;
  }
  return profile(family, low);
}

// x log |x|, and 0 at 0.
double x_log(double x) {
  return x == 0.0 ? 0.0 : x * std::log(std::abs(x));
}

// A load that is uniform up to a and falls linearly to 0 at the trailing edge.
MeanLine mean_line_at(double x, double a, double lift) {
  const double b = 1.0 - a, scale = lift / (2.0 * std::numbers::pi * (a + 1.0));
  const double slope_log = x > 0.0 ? std::log(x) : -40.0;
  if (b < 1e-9)
    return {-lift / (4.0 * std::numbers::pi) * (x_log(1.0 - x) + x_log(x)),
            lift / (4.0 * std::numbers::pi) * ((x < 1.0 ? std::log(1.0 - x) : -40.0) - slope_log)};
  const double g = -(a * (0.5 * x_log(a)) - 0.25 * a * a + 0.25) / b;
  const double h = (0.5 * b * x_log(b) - 0.25 * b * b) / b + g;
  const double d = a - x, e = 1.0 - x;
  const double y = (0.5 * d * x_log(d) - 0.5 * e * x_log(e) + 0.25 * e * e - 0.25 * d * d) / b;
  const double slope = (-x_log(d) + x_log(e)) / b - 1.0 - slope_log - h;
  return {scale * (y - x_log(x) + g - h * x), scale * slope};
}

// The mean line of the 6A-series: that of a = 0.8, straight from 0.87437 on.
MeanLine six_a_mean_line_at(double x, double lift) {
  constexpr double straight = 0.87437, factor = 0.97948;
  const MeanLine end = mean_line_at(straight, 0.8, lift * factor);
  if (x < straight) return mean_line_at(x, 0.8, lift * factor);
  const double slope = -end.y / (1.0 - straight);
  return {end.y + slope * (x - straight), slope};
}

}  // namespace

std::optional<NacaParts> six_series_section(std::string_view text) {
  const std::optional<Designation> section = parsed(text);
  if (!section) return std::nullopt;
  if (section->family == nullptr)
    refuse_naca(text, "a family of which there are tables: 63, 64, 65, 66, 67, 63A, 64A or 65A");
  if (!(section->thickness >= 0.02 && section->thickness <= 0.24))
    refuse_naca(text, "a thickness of 2 to 24 %, which the tables are scaled to");
  if (section->six_a && section->a != 1.0 && section->a != 0.8)
    refuse_naca(text, "no other mean line of the 6A-series than its own, of a = 0.8");
  const double a = section->a, lift = section->lift;
  NacaParts parts{.half_thickness = profile_of_thickness(*section->family, section->thickness),
                  .mean_line = {}};
  if (section->six_a)
    parts.mean_line = [lift](double x) { return six_a_mean_line_at(x, lift); };
  else
    parts.mean_line = [a, lift](double x) { return mean_line_at(x, a, lift); };
  return parts;
}

}  // namespace remodel
