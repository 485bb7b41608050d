#pragma once

// The directory of a sweep: sweep.json, what is to be found and in which chains, and chains/000001.cbor and
// so on, what each finished chain found. A chain whose file is not there is still to be done: that is all
// there is to resuming.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "aero/sweep_record.h"

namespace remodel {

// One chain of a plan, by its place in sweep.json.
struct PlannedChain {
  const SweepPlan* plan = nullptr;
  const std::vector<std::size_t>* sections = nullptr;
  std::size_t flows() const;
};

class SweepDirectory {
 public:
  static bool exists(const std::filesystem::path& directory);
  static void require_there(const std::filesystem::path& directory);  // throws Error (file)
  // Throws Error unless the directory is missing or empty.
  static void require_new(const std::filesystem::path& directory);

  // A new sweep, or one that is there. Throws Error (file, format).
  SweepDirectory(std::filesystem::path directory, SweepProblem problem);
  explicit SweepDirectory(std::filesystem::path directory);

  const SweepProblem& problem() const { return problem_; }
  // Adds what the other sweep has more of, as plans of their own. Throws Error (argument) where they differ
  // otherwise.
  void extend(const SweepProblem& by);
  std::vector<PlannedChain> chains() const;  // the n-th one has the n-th file

  bool is_finished(std::size_t chain) const;
  ChainWork work_of(const PlannedChain& chain) const;
  void write(std::size_t chain, const std::string& result) const;
  ChainResult read(std::size_t chain) const;  // of a finished one

 private:
  std::filesystem::path file_of(std::size_t chain) const;
  void save() const;

  std::filesystem::path directory_;
  SweepProblem problem_;
  std::vector<SweepPlan> plans_;
};

// Plans of the rows that a sweep has and these plans have not.
std::vector<SweepPlan> plans_of_missing(const SweepProblem& problem, const std::vector<SweepPlan>& planned);

}  // namespace remodel
