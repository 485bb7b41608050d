#pragma once

// The constraints of a design problem as its user counts them: an entry of the file is one, however many
// functions it takes.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "remodel/history.h"
#include "report.h"

namespace remodel::app {

constexpr int containment_stations = 39;  // of a surface
// A design is within a constraint that it violates by so much at most, in the measure of the history's column
// `constraints`: what linearised constraints leave at the end of a search, and far above rounding.
constexpr double default_constraint_tolerance = 1e-5;
// That of a problem file.
double constraint_tolerance_of(const Json& problem);

// For each of the evaluator's functions, in their order, the name of its constraint: the kind, and its number
// in the file where there are several of a kind.
std::vector<std::string> constraint_names(const Json& problem);

// By how much a design violates each constraint of the problem at its worst, 0 where that is within the
// tolerance, by name.
Json violations(const Json& problem, const std::vector<double>& constraints);

// Of the designs whose flows were found, the row of the one that violates its worst constraint least; the
// first of several.
std::optional<std::size_t> least_violated(const std::vector<EvaluationRecord>& rows);

// Why a run has no best design: which constraint is violated most at the least violated design, or that no
// flow was found.
std::string why_no_design(const Json& problem, const std::vector<EvaluationRecord>& rows);

}  // namespace remodel::app
