#pragma once

// A coordinate file as lines of two numbers, and what became of them: the steps between text and surfaces.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/airfoil.h"

namespace remodel {

struct AirfoilRow {
  Point point;
  int line = 0;  // of the file, from 1
};

struct AirfoilRows {
  std::string name;  // empty where the file has no name line
  std::vector<AirfoilRow> rows;
};

// Longer texts are no airfoils.
inline constexpr std::size_t airfoil_text_limit = std::size_t{16} << 20;

// The lines. Throws Error (format) for the first line that is not what a coordinate file may hold.
AirfoilRows read_airfoil_rows(std::string_view text, const std::string& source);

// The surfaces of a closed or open outline that runs from the trailing edge around the leading edge back to
// the trailing edge, in either direction; a point that is there twice in a row counts once. Throws Error
// (format) where it is no airfoil's.
AirfoilCoordinates surfaces_of_outline(std::string name, std::vector<AirfoilRow> outline,
                                       const std::string& source);

}  // namespace remodel
