#pragma once

// Plots of curves, by cairo: pressures along walls, residuals of a solution.

#include <filesystem>
#include <string>
#include <vector>

#include "remodel/point.h"

namespace remodel {

struct PlotCurve {
  std::string name;  // in the legend; none if it is empty
  std::vector<Point> points;
};

struct PlotAxis {
  std::string label = {};
  bool logarithmic = false;  // ticks at powers of ten; values have to be more than 0
  bool whole = false;        // ticks at whole numbers: of what is counted
  bool reversed = false;     // larger values to the left, or below: Cp is drawn like that
};

struct Plot {
  PlotAxis x = {}, y = {};
  std::vector<PlotCurve> curves = {};
  std::string caption = {};  // above the plot
  int width = 1200;          // pixels, 200 to 8000; the height is two thirds of it
};

// .svg or .png by extension, written atomically. Error (argument) for another extension, no points, values
// that are not finite or that a logarithmic axis cannot show, and a width out of range.
void draw_plot(const Plot& plot, const std::filesystem::path& file);

}  // namespace remodel
