#pragma once

// The loop of a run: ask, feasible?, mesh, evaluate, tell; with its directory, its history and its
// checkpoints. It knows nothing of what designs, designers and evaluators are.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "remodel/optimise.h"

namespace remodel {

struct LoopParts {
  const DesignSpace& space;
  Designer& designer;
  Evaluator& evaluator;
  // With a tolerance: an objective that is half way there, for the mesh in the middle.
  std::optional<double> half_way{};
  std::map<std::string, std::string> facts{};       // more rows of the history's table `run`
  std::function<void(OptimiseResult&)> complete{};  // says more of the result's best design
};

OptimiseResult run_design_loop(const LoopParts& problem, const OptimiseOptions& options,
                               OptimiseObserver* observer);

// Throws Error (argument) where the directory holds a run.
void require_no_other_run(const std::filesystem::path& directory);

}  // namespace remodel
