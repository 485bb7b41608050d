#pragma once

// The word that a designer and an evaluator have in common: what came of one design.

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace remodel {

// The smaller the objective, the better. A constraint is satisfied where it is at most 0.
struct Evaluation {
  static constexpr double failed = std::numeric_limits<double>::infinity();

  double objective = failed;
  std::vector<double> constraints{};  // the same number for every design
  // These are derivatives by the design's parameters: of the objective, then a row for each constraint. They
  // are empty where none was asked for or none is to be had.
  std::vector<double> gradient{};
  std::vector<std::vector<double>> constraint_gradients{};
  std::map<std::string, double> outputs{};  // whatever else the history is to keep, by name
};

// This is how much the worst constraint is violated by; 0 where all are satisfied. NaN counts as infinity.
double violation_of(const std::vector<double>& constraints);

}  // namespace remodel
