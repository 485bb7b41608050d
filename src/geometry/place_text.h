#pragma once

// Numbers and places for messages, in as many digits as it takes to tell neighbours apart.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "remodel/point.h"

namespace remodel {

// The shortest of 15 to 17 digits that reads as the same number. (Some libraries lack std::to_chars() of it.)
inline std::string exact_text(double value) {
  char text[32];
  for (int digits = 15; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}
inline std::string exact_text(Point p) {
  return "(" + exact_text(p.x) + ", " + exact_text(p.y) + ")";
}
// Three digits: of distances.
inline std::string rough_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace remodel
