#pragma once

// The layer of cells that a flow with friction needs on walls.

#include <string>
#include <vector>

#include "remodel/flow.h"
#include "remodel/layers.h"

namespace remodel {

//   Domain domain = airfoil_domain(named_airfoil("naca:0012", 5));
//   space_walls(domain, {});
//   LayeredMesh mesh = generate_layered(domain, layer_for_flow(FlowModel::sa, 6e6), {.gradation = 8.0}).mesh;
//
// The Reynolds number is that of a chord of 1. The thickness is 1.2 times a turbulent boundary layer's
// (boundary_layer_thickness()), for laminar flow 1.2 times the larger one of that and Blasius's, 5 /
// sqrt(Re), which counts up to half a chord. The first cell of laminar flow is a 500th of Blasius's
// thickness high. That of turbulent flow is as high as y+ = 1 on a flat plate, and a 150th of that thickness
// at most. Throws Error (argument) for a model without friction and a Reynolds number that is not 1 to 1e12.
LayerOptions layer_for_flow(FlowModel model, double reynolds);

// So long a wake, in chords, at an angle counter-clockwise from the x axis.
WakeLine wake_at(double length, double angle_deg);

// LayerOptions::walls for a flow with these options: the names of closed loops' curves that are neither the
// far field nor inlets, outlets, symmetry planes and periodic curves. Empty where there is nothing but a far
// field.
std::vector<std::string> walls_of_flow(const Domain& domain, const FlowOptions& options);

}  // namespace remodel
