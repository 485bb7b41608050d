#include "study/schedule.h"

#include <algorithm>
#include <utility>

#include "design/airfoil_space.h"

namespace remodel {
namespace {

// The seconds that a job took.
double seconds_of(const StudyRows& rows) {
  if (const auto* path = std::get_if<PathRows>(&rows)) return path->seconds;
  if (const auto* replay = std::get_if<ReplayRows>(&rows)) return replay->replay.seconds;
  double sum = 0.0;
  for (const FreshRow& row : std::get<FreshRows>(rows)) sum += row.seconds;
  return sum;
}

}  // namespace

Schedule::Schedule(StudyStore& store, StudyObserver& observer)
    : Schedule(store, observer, plan(store.options())) {}

Schedule::Schedule(StudyStore& store, StudyObserver& observer, std::vector<PlannedJob> jobs)
    : JobQueue(jobs.size()), store_(store), observer_(observer), jobs_(std::move(jobs)) {
  const std::set<JobKey> finished = store.finished();
  progress_.jobs = jobs_.size();
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    progress_.core_seconds += jobs_[i].core_seconds;
    if (!finished.contains(jobs_[i].key)) continue;
    mark_done(i);
    ++progress_.done;
    progress_.core_seconds_done += jobs_[i].core_seconds;
  }
  progress_.core_seconds_before = progress_.core_seconds_done;
}

bool Schedule::can_begin(std::size_t number) const {
  return std::all_of(jobs_[number].needs.begin(), jobs_[number].needs.end(),
                     [&](std::size_t needed) { return is_done(needed); });
}

std::string Schedule::work_of(std::size_t number) const {
  return encode(work_of(jobs_[number].key));
}

StudyWork Schedule::work_of(const JobKey& key) const {
  const StudyOptions& options = store_.options();
  const CstAirfoil from = study_start().design, &to = options.airfoils[key.airfoil].design;
  const int degree = std::max(from.degree(), to.degree());
  StudyWork work;
  work.kind = key.kind;
  work.from = raise_degree(from, degree);
  work.to = raise_degree(to, degree);
  work.evaluations = options.evaluations;
  work.compare_every = options.compare_every;
  work.check_every = options.check_every;
  work.validate_every = options.validate_every;
  if (key.kind == JobKind::path) {
    work.sigma = options.sigmas[key.sigma];
    work.seed = scenario_seed(options, key);
    for (const StudyPair& pair : options.pairs) work.points.push_back(pair.points);
    return work;
  }
  work.pair = options.pairs[key.pair];
  work.path = store_.path(key);
  if (key.kind == JobKind::fresh) return work;
  work.distance = options.distances[key.distance];
  work.strategy = options.strategies[key.strategy];
  if (compares(options)) work.fresh = store_.fresh(key);
  return work;
}

void Schedule::finish(std::size_t number, const std::string& bytes) {
  const StudyRows rows = decode_rows(bytes);
  finish_once(number, [&] {
    store_.write(jobs_[number].key, rows);
    ++progress_.done;
    progress_.core_seconds_done += jobs_[number].core_seconds;
    progress_.job = describe(store_.options(), jobs_[number].key);
    progress_.job_seconds = seconds_of(rows);
    observer_.finished(progress_);
  });
}

}  // namespace remodel
