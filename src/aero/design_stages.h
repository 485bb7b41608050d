#pragma once

// A search from coarse to fine meshes: each is a run of its own, in a directory of its own within that of the
// run, and the next one begins with its best design and what its designer has learnt.

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "remodel/design_run.h"

namespace remodel {

// A search on one mesh: its result, and the state of its designer at the end.
struct SearchOnMesh {
  DesignResult result;
  std::string designer;
};
// Searches on the mesh of problem.domain.points. `carried`: the state of another mesh's designer; empty:
// none.
using SearchMesh = std::function<SearchOnMesh(const DesignProblem& problem, const DesignRunOptions& options,
                                              const std::string& carried, OptimiseObserver* observer)>;

DesignResult search_coarse_to_fine(const DesignProblem& problem, const DesignRunOptions& options,
                                   const SearchMesh& search, OptimiseObserver* observer);

// The run's stages but its last one, from the first on: DIRECTORY/stage-1, ...
std::filesystem::path stage_directory(const std::filesystem::path& directory, std::size_t stage);
// Whatever stages there are from this one on are removed.
void remove_stages(const std::filesystem::path& directory, std::size_t first);
// Calls a function once, after the first design of a run is on the disk.
class AtFirstDesign final : public OptimiseObserver {
 public:
  AtFirstDesign(OptimiseObserver* observer, std::function<void()> call)
      : observer_(observer), call_(std::move(call)) {}
  void evaluated(const EvaluationRecord& record) override {
    if (call_) std::exchange(call_, nullptr)();
    if (observer_ != nullptr) observer_->evaluated(record);
  }
  bool cancelled() override { return observer_ != nullptr && observer_->cancelled(); }

 private:
  OptimiseObserver* observer_;
  std::function<void()> call_;
};

}  // namespace remodel
