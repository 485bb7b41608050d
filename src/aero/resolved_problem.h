#pragma once

// A design problem with its names looked up and everything in it judged.

#include <optional>
#include <string>
#include <vector>

#include "aero/kinds.h"

namespace remodel {

struct ResolvedProblem {
  // A limit of a function of one point's flow.
  struct FlowLimit {
    std::size_t function = 0, point = 0;
    double factor = 1.0;  // times (value - limit) is to be at most 0
    double limit = 0.0;
    std::string name;
  };
  struct DomainLimit {
    DomainConstraintPtr constraint;
    std::string name;
  };

  std::unique_ptr<FlowSpace> space;
  std::vector<FlowFunctionPtr> functions;  // each once; the first one is the objective
  double sense = 1.0;                      // of the objective: -1 made large
  std::optional<Domain> target;            // of inverse design: the walls
  std::vector<DomainLimit> domain;         // in the order of evaluations
  std::vector<FlowLimit> flow;             // behind them
  std::vector<double> first_design;        // of the search

  std::vector<std::string> names() const;  // of each function of an evaluation
};

// The layer that serves all of these points, which have friction: on sections, whose chord is 1, or on the
// walls of a domain, for which the reference length stands.
LayerOptions layer_for_points(const std::vector<DesignPoint>& points, bool of_domain);

// Throws Error (argument), as validate() does.
ResolvedProblem resolved(const DesignProblem& problem, const std::string& source);

}  // namespace remodel
