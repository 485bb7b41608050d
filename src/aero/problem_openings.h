#pragma once

// Inlets, outlets and symmetry planes of a design's point of flow, as problem files have them.

#include <string>

#include "aero/problem_json.h"
#include "aero/problem_place.h"
#include "remodel/design_problem.h"

namespace remodel {

// The keys `inlets`, `outlets` and `symmetry` of a point. Throws Error (format) naming `where` and the key.
void read_openings(const Json& point, const std::string& where, DesignPoint& to);
void write_openings(const DesignPoint& point, Json& to);

// Throws for openings that a flow through this domain cannot have.
void require_openings(const DesignPoint& point, const Domain& domain, const ProblemPlace& place);

}  // namespace remodel
