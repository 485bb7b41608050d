#pragma once

#include <string>
#include <vector>

#include "meshing_options.h"
#include "remodel/airfoil.h"
#include "report.h"

namespace remodel::app {

// A SHAPE with its fit errors: those of the table for a catalogue name, zero for a .json file of
// coefficients, those of a fit for everything else. Throws Error as load_airfoil() does. Where the surfaces
// of the fit of the degree asked for cross and another degree was taken, a line on standard error says so.
CstFit fit_shape(const std::string& shape, const FitOptions& options);

// Whether the shape is a file of coordinates, of which there is a fit to report.
bool is_coordinate_file(const std::string& shape);

struct ShapeFit {
  std::string shape;
  CstFit fit;
};
// The same, and adds the fit of a file of coordinates to those to be reported.
CstFit fit_shape(const std::string& shape, const FitOptions& options, std::vector<ShapeFit>& fits);
// Reports fits of coordinate files: as "fits" in JSON, as a line each in text. Nothing if there are none.
void add_fit_figures(Report& report, const std::vector<ShapeFit>& fits);

}  // namespace remodel::app
