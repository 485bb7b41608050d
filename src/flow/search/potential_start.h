#pragma once

// Potential flow as a start: half the Newton steps that undisturbed flow takes, where nothing is faster than
// sound, and fewer steps while shocks are weak.

#include <optional>

#include "flow/scheme/flow_system.h"

namespace remodel::flow {

// The velocities of the potential flow through the mesh (remodel/potential_flow.h), with the density and the
// pressure that gas of the stream's entropy and total enthalpy has at them. Velocities are cut off at Mach 0.9:
// those of the incompressible flow rise without bound at noses. The lift is that by Prandtl and Glauert's rule, the
// angle the one that has a given lift. None beyond SearchPolicy::most_mach_of_potential, without a far field, beside
// other open boundaries and symmetry planes, and where there is no potential flow.
std::optional<State> potential_start(const FlowSystem& system);

}  // namespace remodel::flow
