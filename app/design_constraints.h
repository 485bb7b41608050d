#pragma once

// The constraints of a design problem as its user counts them: an entry of the file is one, however many
// functions it takes.

#include <string>
#include <vector>

#include "report.h"

namespace remodel::app {

constexpr int containment_stations = 39;  // of a surface
// A design is within a constraint that it violates by so much at most, in the measure of the history's column
// `constraints`: what linearised constraints leave at the end of a search, and far above rounding.
constexpr double default_constraint_tolerance = 1e-5;

// By how much a design violates each constraint at its worst, 0 where that is within the tolerance, by name.
// `names`: of the constraint that each function is of, DesignProblemFile::constraint_names().
Json violations(const std::vector<std::string>& names, double tolerance,
                const std::vector<double>& constraints);

}  // namespace remodel::app
