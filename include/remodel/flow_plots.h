#pragma once

// Flows as plots.

#include <span>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/plot.h"

namespace remodel {

// "M 0.8, α = 1.25°, CL = 0.3543"; without CL where that is not a number.
std::string flow_caption(double mach, double alpha_deg, double cl);

// "M 0.3": no lift and no angle belong to a duct.
std::string duct_caption(double mach);

// The mesh without the boundaries of these names, which are no walls to plot along: openings, planes of
// symmetry.
FrozenMesh without_boundaries(FrozenMesh mesh, std::span<const std::string> names);

// The pressure coefficients of vertices along every boundary but those of the far field, smaller ones above,
// over x: a curve for each body, or each piece of a wall, by the boundary's name and a number where there are
// several. Throws Error (argument) naming `option` where there is no other boundary.
Plot cp_plot(const FrozenMesh& mesh, const std::vector<std::string>& farfield, std::span<const double> cp,
             const std::string& caption, const std::string& option);

// This plots the friction likewise, FlowFriction::cf, larger values above.
Plot cf_plot(const FrozenMesh& mesh, const std::vector<std::string>& farfield, std::span<const double> cf,
             const std::string& caption, const std::string& option);

// Residuals over steps: a table (.csv) or a plot (.svg, .png), by the file's extension.
void write_residuals(std::span<const double> residuals, const std::string& caption, const std::string& file);

}  // namespace remodel
