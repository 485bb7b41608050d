#pragma once

// What NACA sections are made of: a mean line and half a thickness over it.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/point.h"

namespace remodel {

struct MeanLine {
  double y = 0.0;
  double slope = 0.0;
};
using MeanLineFunction = std::function<MeanLine(double x)>;

// Points (x, half the thickness) from the leading to the trailing edge.
struct NacaParts {
  std::vector<Point> half_thickness;
  MeanLineFunction mean_line;
};

// "0012", "23012", "0012-64", "23012-34": none for what is no such designation. Refuses by name what is one
// and has no closed form here.
std::optional<NacaParts> digit_section(std::string_view designation);
// "63-206", "65(1)-412", "64A010", "63-206 a=.8" likewise.
std::optional<NacaParts> six_series_section(std::string_view designation);

[[noreturn]] void refuse_naca(std::string_view designation, const std::string& expected);

}  // namespace remodel
