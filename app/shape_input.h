#pragma once

#include <string>
#include <vector>

#include "meshing_options.h"
#include "remodel/airfoil.h"
#include "remodel/shape_domain.h"
#include "report.h"

namespace remodel::app {

// load_fit() of a SHAPE; its warnings are said. Throws Error as it does.
CstFit fit_shape(const std::string& shape, const FitOptions& options);

// The same, and adds the fit of a file of coordinates to those to be reported.
CstFit fit_shape(const std::string& shape, const FitOptions& options, std::vector<ShapeFit>& fits);
// Throws Error (argument) where --close-trailing-edge is given and none of the shapes is a coordinate file.
void require_coordinate_file(const std::vector<std::string>& shapes, const FitOptions& options);
// The frame of a coordinate file, as JSON: turned_deg, sheared (y per x), scaled, moved, closed, and place as
// --place takes it.
Json frame_json(const AirfoilFrame& frame);
// Reports fits of coordinate files: as "fits" in JSON, as a line each in text. Nothing if there are none.
void add_fit_figures(Report& report, const std::vector<ShapeFit>& fits);

}  // namespace remodel::app
