#pragma once

// Lift and drag along a line of airfoils, for measure_noise() (remodel/noise.h).

#include <memory>

#include "remodel/flow.h"
#include "remodel/noise.h"

namespace remodel {

// CL and CD ("cl", "cd") of compressible flow, of which derivatives are known by the adjoint method. The
// designs are those of an AirfoilSpace, the first loop of whose domain is the airfoil. Flows go on from the
// last one where meshes do. Throws Error (argument) as LivingFlow::solve() does; options.observer is that of
// the measurement.
std::unique_ptr<LineObjective> flow_line_objective(const FlowConditions& conditions,
                                                   const FlowOptions& options = {});

}  // namespace remodel
