#pragma once

// Gradients of flows of each model: what functions follow, put together with the multipliers of Gradients.

#include "flow/living_flow/gradients.h"
#include "flow/scheme/flow_system.h"
#include "flow/scheme/friction_system.h"

namespace remodel::flow {

// As LivingFlow::gradients() says.
FlowGradients gradients_of(const LastFlow<unknown_count>& last, const std::vector<FlowFunctional>& functions,
                           const WantedGradients& wanted, WholeMatrix& matrix,
                           Gradients<unknown_count>& gradients);
template <std::size_t N>
FlowGradients gradients_of(const LastFlow<N>& last, const Viscosity& viscosity,
                           const std::vector<FlowFunctional>& functions, const WantedGradients& wanted,
                           BlockWholeMatrix<N>& matrix, Gradients<N>& gradients);

// The derivatives that a function was given by, after a check of their sizes.
struct GivenSlope {
  ShapeSlope shape;
  Vector state;
};
GivenSlope slope_of(const FlowFunctional& function, std::size_t size);

}  // namespace remodel::flow
