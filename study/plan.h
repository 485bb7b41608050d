#pragma once

// The plan of a study: its jobs, their order, and the ids of their rows.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "study/study.h"
#include "study/work.h"

namespace remodel {

// Indices into the lists of StudyOptions, and the scenario, counted from 1. Members that a kind of job does
// not depend on are 0.
struct JobKey {
  JobKind kind = JobKind::path;
  std::size_t airfoil = 0, sigma = 0, scenario = 1;
  std::size_t pair = 0;
  std::size_t distance = 0, strategy = 0;
  friend auto operator<=>(const JobKey&, const JobKey&) = default;

  JobKey path() const { return {.airfoil = airfoil, .sigma = sigma, .scenario = scenario}; }
  JobKey fresh() const {
    return {.kind = JobKind::fresh, .airfoil = airfoil, .sigma = sigma, .scenario = scenario, .pair = pair};
  }
};

// Ids of rows: decimal digits of the indices, counted from 1, so that they do not depend on the order in
// which jobs end, nor on what a study is extended by. Airfoil, sigma (two digits each), scenario (four); for
// replays followed by pair, distance, strategy (two each).
std::uint64_t scenario_id(const JobKey& key);
std::uint64_t replay_id(const JobKey& key);
inline constexpr std::size_t longest_list = 99, most_scenarios = 9999;

// The seed of a scenario's optimiser.
inline std::uint64_t scenario_seed(const StudyOptions& options, const JobKey& key) {
  return options.seed + key.scenario - 1;
}

// A description such as "replay rae2822, sigma 0.05, scenario 1, 700/14, D 4, renew".
std::string describe(const StudyOptions& options, const JobKey& key);

struct PlannedJob {
  JobKey key;
  double core_seconds = 0.0;       // estimated
  std::vector<std::size_t> needs;  // jobs that come before, by index
};

// All jobs, the most urgent first. Scenario 1 of every airfoil and sigma comes first, so that an interrupted
// study has results for each. Within a scenario, jobs with the longest path of dependent jobs come first,
// then the longest jobs.
std::vector<PlannedJob> plan(const StudyOptions& options);

// True if any evaluations are compared with fresh meshes.
bool compares(const StudyOptions& options);

}  // namespace remodel
