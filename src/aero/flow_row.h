#pragma once

// What rows of flows over angles of attack or lift coefficients share: those of polars and those of sweeps.

#include <functional>
#include <vector>

#include "aero/flow_march.h"
#include "remodel/flow.h"
#include "remodel/polar.h"

namespace remodel::aero {

// The index of the value that a row begins at.
std::size_t nearest_to_zero(const std::vector<double>& values);

using RowSolve = std::function<FlowResult(LivingFlow&, const FlowConditions&)>;
// The flow at an angle, or at a lift whose angle is looked for from alpha_deg on. From nothing that may be
// one far beyond the largest lift, where the same lift is found again: a living flow that knows none begins
// with the flow at alpha_deg, whose start, steps and seconds the result has too.
FlowResult find_at(LivingFlow& living, const RowSolve& solve, FlowConditions conditions, double value,
                   bool over_lift, double alpha_deg);

// A flow of a row as results have it.
PolarPoint point_of(const MarchedFlow& marched, bool over_lift);

}  // namespace remodel::aero
