#pragma once

// Designs of a search on fresh meshes, which it has not seen.

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "aero/resolved_problem.h"
#include "remodel/design_run.h"

namespace remodel {

using OnFlowStep = std::function<void(const FlowProgress&)>;

// The gradation of a problem's meshes; with friction away from the tops of layers.
double gradation_of(const DesignProblem& problem);

// The flows of all points on a mesh for each number in DesignProblem::verify, found cold. The meshes have the
// size and the angles of the search's first one: figures on several of them are of one family. Adds to
// `flows`, and returns what kept one of the meshes or flows from being finished, or Stopped::done.
Stopped add_fresh_flows(const DesignProblem& problem, const ResolvedProblem& parts,
                        std::span<const double> design, StepObserver& observer, const OnFlowStep& on_step,
                        std::vector<FreshFlow>& flows);

// Writes fresh.json. The file says of which design it is: a search that goes on may find a better one.
void write_fresh(const DesignResult& result, const std::filesystem::path& directory);

}  // namespace remodel
