#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "remodel/error.h"
#include "remodel/polar.h"

namespace remodel {

namespace {

[[noreturn]] void refuse_range(const std::string& option, std::string_view text,
                               const std::string& expected) {
  throw Error(ErrorCode::argument, option, "found '" + std::string(text) + "', expected " + expected);
}

std::string range_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// The numbers between colons.
std::vector<double> numbers_of(const std::string& option, std::string_view text) {
  std::vector<double> numbers;
  std::string_view rest = text;
  while (true) {
    const std::size_t colon = rest.find(':');
    const std::string_view word = rest.substr(0, colon);
    double number = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(number)) break;
    numbers.push_back(number);
    if (colon == std::string_view::npos) {
      if (numbers.size() == 1 || numbers.size() == 3) return numbers;
      break;
    }
    rest.remove_prefix(colon + 1);
  }
  refuse_range(option, text, "a number, or FIRST:LAST:STEP");
}

double rounded(double value) {
  constexpr int digits = 12;
  std::array<char, 40> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

}  // namespace

std::vector<double> parse_range(const std::string& option, std::string_view text, ValueRange range) {
  const std::vector<double> given = numbers_of(option, text);
  const double first = given.front(), last = given.size() == 1 ? first : given[1];
  if (first < range.low || last > range.high || first > range.high || last < range.low)
    refuse_range(option, text, "numbers from " + range_text(range.low) + " to " + range_text(range.high));
  if (given.size() == 1) return given;
  const double step = given[2];
  if (last < first) refuse_range(option, text, "a last value that is not below the first one");
  if (!(step > 0.0)) refuse_range(option, text, "a step above 0");
  constexpr double rounding = 1e-9;  // of a step
  const double steps = std::floor((last - first) / step + rounding);
  if (!(steps < static_cast<double>(most_polar_values)))
    refuse_range(option, text, "at most " + std::to_string(most_polar_values) + " values");
  std::vector<double> values;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    const double value = rounded(std::fma(i, step, first));
    if (!values.empty() && !(value > values.back()))
      refuse_range(option, text, "a step that 12 digits can show");
    values.push_back(value);
  }
  return values;
}

}  // namespace remodel
