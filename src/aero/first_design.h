#pragma once

// The design that a search begins with, where that is not the start of its space.

#include <string>
#include <vector>

#include "aero/problem_place.h"
#include "remodel/design_problem.h"

namespace remodel {

// The design that DesignProblem::start names, or first_design, or that of the space. Throws for a design that
// is the same shape in this space no more, or that it does not allow.
std::vector<double> first_design_of(const DesignProblem& problem, const FlowSpace& space,
                                    const ProblemPlace& place);

}  // namespace remodel
