#pragma once

// Flows as the results of polars and sweeps have them.

#include "aero/flow_march.h"
#include "remodel/flow.h"
#include "remodel/polar.h"

namespace remodel::aero {

// What a point is made of: fields are the largest part of a flow by far.
FlowResult without_fields(FlowResult flow);

PolarPoint point_of(const MarchedFlow& marched, bool over_lift);

}  // namespace remodel::aero
