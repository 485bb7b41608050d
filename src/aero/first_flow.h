#pragma once

// The first flow of a search, where it is not found straight away: it is looked for by way of easier ones.

#include <functional>

#include "remodel/flow.h"

namespace remodel::aero {

// Looks for a flow from the last one that was found.
using FindFlow = std::function<FlowResult(const FlowConditions& conditions)>;

// `direct` is the flow at these conditions as it was not found. The easier flow has no angle or lift, and a
// Mach number of a half at most, of streams slower than sound; from there the march goes to the conditions.
// It ends with the flow there, or with `direct`. Nothing is looked for where no flow is easier.
FlowResult by_easier_flows(const FlowConditions& conditions, FlowResult direct, const FindFlow& find);

}  // namespace remodel::aero
