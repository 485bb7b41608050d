#pragma once

// What is given for flows in Python, as the library has it.

#include <array>
#include <optional>

#include "bindings.h"
#include "remodel/flow.h"

namespace remodel::python {

using Transition = std::optional<std::array<double, 2>>;

// Throws Error (argument) for numbers out of range.
FlowConditions conditions_of(double mach, double alpha, const std::optional<double>& cl,
                             const std::array<double, 2>& reference, double reference_length, double reynolds,
                             const Transition& transition, const std::optional<double>& wall_temperature);
void require_reynolds_with_friction(FlowModel model, double reynolds);
// The options of an object LivingFlow.
FlowOptions flow_options_of(const py::object& living_flow);

}  // namespace remodel::python
