#pragma once

// Plots of curves, by cairo: pressures along walls, residuals of a solution.

#include <filesystem>
#include <string>
#include <vector>

#include "remodel/point.h"

namespace remodel {

struct PlotCurve {
  std::string name = {};  // in the legend, which stands in the corner with the fewest points; none if it is empty
  std::vector<Point> points = {};
  bool dots = false;  // one at each point; curves of up to three points have them anyway
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

// Several on one page, row by row, so many in a row (1 or more); all have the width of the first one. Errors as above,
// and Error (argument) where there is no plot.
void draw_plots(const std::vector<Plot>& plots, int columns, const std::filesystem::path& file);

}  // namespace remodel
