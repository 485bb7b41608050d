#include "study/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

namespace remodel {
namespace {

// Estimated times of jobs, measured on one core of 2023. Only the order of jobs and the estimate of the
// remaining time depend on them. In small meshes the boundary takes most of the time, in large ones the
// triangles.
double milliseconds(double boundary, double triangles, const StudyPair& pair) {
  const double size = pair.points / 50.0;
  return boundary * size + triangles * std::pow(size, 2.4);
}
constexpr double path_ms = 0.01;  // per evaluation

double core_seconds(const StudyOptions& options, const JobKey& key) {
  const double evaluations = static_cast<double>(options.evaluations);
  const double compared = compares(options) ? evaluations / static_cast<double>(options.compare_every) : 0.0;
  const double checked = evaluations / static_cast<double>(options.check_every);
  const double validated = evaluations / static_cast<double>(options.validate_every);
  const StudyPair& pair = options.pairs[key.pair];
  switch (key.kind) {
    case JobKind::path:
      return 1e-3 * evaluations * path_ms;
    case JobKind::fresh:
      return 1e-3 * compared * milliseconds(0.25, 0.009, pair);
    case JobKind::replay:
      return 1e-3 * (evaluations * milliseconds(0.024, 0.0009, pair) +
                     (checked + compared) * milliseconds(0.02, 0.012, pair) +
                     validated * milliseconds(1.2, 0.2, pair));
  }
  return 0.0;
}

template <typename Visit>
void each_scenario(const StudyOptions& options, Visit visit) {
  for (std::size_t scenario = 1; scenario <= options.scenarios; ++scenario)
    for (std::size_t airfoil = 0; airfoil < options.airfoils.size(); ++airfoil)
      for (std::size_t sigma = 0; sigma < options.sigmas.size(); ++sigma)
        visit(JobKey{.airfoil = airfoil, .sigma = sigma, .scenario = scenario});
}

std::vector<JobKey> keys_of(const StudyOptions& options) {
  std::vector<JobKey> keys;
  each_scenario(options, [&](JobKey key) {
    keys.push_back(key);
    for (key.pair = 0; key.pair < options.pairs.size(); ++key.pair) {
      if (compares(options)) keys.push_back(key.fresh());
      key.kind = JobKind::replay;
      for (key.distance = 0; key.distance < options.distances.size(); ++key.distance)
        for (key.strategy = 0; key.strategy < options.strategies.size(); ++key.strategy) keys.push_back(key);
    }
  });
  return keys;
}

// The urgency of each job: the length of the longest path of dependent jobs that begins with it.
std::vector<double> urgencies(const StudyOptions& options, const std::vector<JobKey>& keys) {
  std::map<JobKey, double> after;  // the longest path that depends on a job
  std::vector<double> result(keys.size());
  const auto wait = [&](const JobKey& key, double seconds) {
    double& longest = after[key];
    longest = std::max(longest, seconds);
  };
  for (const JobKind kind : {JobKind::replay, JobKind::fresh, JobKind::path}) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (keys[i].kind != kind) continue;
      result[i] = core_seconds(options, keys[i]) + after[keys[i]];
      if (kind == JobKind::replay) wait(keys[i].fresh(), result[i]);
      if (kind != JobKind::path) wait(keys[i].path(), result[i]);
    }
  }
  return result;
}

std::string text_of(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", number);
  return text.data();
}

}  // namespace

bool compares(const StudyOptions& options) {
  return options.compare_every != 0 && options.compare_every <= options.evaluations;
}

std::uint64_t scenario_id(const JobKey& key) {
  return ((key.airfoil + 1) * 100 + key.sigma + 1) * 10000 + key.scenario;
}

std::uint64_t replay_id(const JobKey& key) {
  return ((scenario_id(key) * 100 + key.pair + 1) * 100 + key.distance + 1) * 100 + key.strategy + 1;
}

std::string describe(const StudyOptions& options, const JobKey& key) {
  static constexpr std::array kinds{"path", "fresh meshes", "replay"};
  std::string text = std::string(kinds[static_cast<std::size_t>(key.kind)]) + " " +
                     options.airfoils[key.airfoil].name + ", sigma " + text_of(options.sigmas[key.sigma]) +
                     ", scenario " + std::to_string(key.scenario);
  if (key.kind == JobKind::path) return text;
  const StudyPair& pair = options.pairs[key.pair];
  text += ", " + std::to_string(pair.points) + "/" + text_of(pair.gradation);
  if (key.kind == JobKind::fresh) return text;
  return text + ", D " + text_of(options.distances[key.distance]) + ", " + options.strategies[key.strategy];
}

std::vector<PlannedJob> plan(const StudyOptions& options) {
  const std::vector<JobKey> keys = keys_of(options);
  const std::vector<double> urgency = urgencies(options, keys);
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (keys[a].scenario != keys[b].scenario) return keys[a].scenario < keys[b].scenario;
    return urgency[a] > urgency[b];
  });
  std::map<JobKey, std::size_t> place;
  for (std::size_t i = 0; i < order.size(); ++i) place[keys[order[i]]] = i;

  std::vector<PlannedJob> jobs;
  for (const std::size_t index : order) {
    const JobKey& key = keys[index];
    PlannedJob job{.key = key, .core_seconds = core_seconds(options, key), .needs = {}};
    if (key.kind != JobKind::path) job.needs.push_back(place.at(key.path()));
    if (key.kind == JobKind::replay && compares(options)) job.needs.push_back(place.at(key.fresh()));
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace remodel
