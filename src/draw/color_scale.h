#pragma once

// The meaning of a cell's colour, and the colours themselves.

#include <cstdint>
#include <string>
#include <vector>

#include "remodel/draw.h"

namespace remodel::draw_detail {

struct Color {
  double red, green, blue;
};

enum class ColorMap {
  sequential,  // perceptually uniform, from dark blue (0) to bright yellow (1)
  diverging,   // blue (0), grey (0.5), red (1)
  embers,      // nearly white (0), pale orange (0.5), glowing red (1)
  tints,       // light colours that have no order: blue, orange, green, rose, grey
};
Color color_at(ColorMap map, double t);
// Below this position dark lines cannot be seen.
double dark_end(ColorMap map);

// The scale of a picture: one position in [0, 1] for each of the given cells.
struct ColorScale {
  std::string title;
  std::string low, high;  // labels of its ends
  std::vector<double> positions;
  ColorMap map = ColorMap::sequential;
  int legend_steps = 128;  // colours that the legend shows
};

// Throws Error (argument) if the mesh does not carry what the colouring shows.
ColorScale color_scale(const FrozenMesh& mesh, const std::vector<std::uint32_t>& cells, DrawColor color);

// A number for a label: four digits are enough to read.
std::string label_of(double value);

}  // namespace remodel::draw_detail
