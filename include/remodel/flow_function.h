#pragma once

// Functions of flows with their derivatives: what a design makes small, or keeps within a limit. Those that
// have names (drag, lift, moment, suction ...) are listed in src/aero/kinds.cpp; a
// function of the user's own is a FlowFunctionOf.
//
//   problem.objective = "side force squared";
//   problem.own_objective = [](const FlowView& of) {
//     return FlowValue{.value = of.flow.cl * of.flow.cl, .by_lift = 2.0 * of.flow.cl};
//   };

#include <functional>
#include <map>
#include <optional>

#include "remodel/domain.h"
#include "remodel/flow.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

// Pressure coefficients at the stations of a section (the first curve of the domain), by parameter.
using StationPressures = std::map<double, double>;

// The flow around one design at one point of its problem.
struct FlowView {
  const Domain& domain;      // of the bodies: frozen.curve counts its curves
  const FrozenMesh& frozen;  // its points are those of the flow's fields
  const FlowResult& flow;    // converged. Coefficients are of the whole, also where half of it was found
  // These are pressures of the section DesignProblem::target, at the same conditions; null where there is
  // none.
  const StationPressures* target = nullptr;
};

// A value with its derivatives. Those by coefficients of forces and by the flow's pressures and points add
// up.
struct FlowValue {
  double value = 0.0;
  double by_drag = 0.0, by_lift = 0.0, by_moment = 0.0;  // by FlowResult::cd, cl, cm
  double by_pressure_drag = 0.0;                         // by FlowFriction::cd_pressure
  std::optional<FlowFunctional> by_flow = {};            // by pressures and points, at fixed coefficients
};

// Called from several threads at once, for different points. Where it throws, the design counts as one whose
// evaluation failed.
using FlowFunctionOf = std::function<FlowValue(const FlowView&)>;

}  // namespace remodel
