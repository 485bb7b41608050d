#pragma once

// The area and the thickness of a loop of a deformed domain: of the polygon of its stations, the body's where
// the loop is a hole, otherwise the domain's.

#include "aero/kinds.h"

namespace remodel {

DomainConstraintPtr area_of_loop(const DomainRequest& request);
// At each of `x`, in units of the domain: from the lowest to the highest place there.
DomainConstraintPtr thickness_of_loop(const DomainRequest& request);

}  // namespace remodel
