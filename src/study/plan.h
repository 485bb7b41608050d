#pragma once

// What there is to do in a study, in which order, and under which numbers its rows go.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "remodel/study.h"
#include "study/work.h"

namespace remodel {

// Indices into the lists of StudyOptions; scenario counts from 1. What a kind does not depend on is 0.
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

// Of the optimiser of a scenario.
inline std::uint64_t scenario_seed(const StudyOptions& options, const JobKey& key) {
  return options.seed + key.scenario - 1;
}

// "replay rae2822, sigma 0.05, scenario 1, 700/14, D 4, renew"
std::string describe(const StudyOptions& options, const JobKey& key);

struct PlannedJob {
  JobKey key;
  double core_seconds = 0.0;       // estimated
  std::vector<std::size_t> needs;  // jobs that come before, by index
};

// In the order of urgency: first scenarios first, so that an interrupted study has something to show of every
// airfoil and sigma; in them what most is waiting for, the longest jobs before the others.
std::vector<PlannedJob> plan(const StudyOptions& options);

// Whether evaluations are compared at all.
bool compares(const StudyOptions& options);

}  // namespace remodel
