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
    : store_(store),
      observer_(observer),
      jobs_(plan(store.options())),
      states_(jobs_.size(), State::waiting) {
  const std::set<JobKey> finished = store.finished();
  progress_.jobs = jobs_.size();
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    progress_.core_seconds += jobs_[i].core_seconds;
    if (!finished.contains(jobs_[i].key)) continue;
    states_[i] = State::done;
    ++progress_.done;
    progress_.core_seconds_done += jobs_[i].core_seconds;
  }
  progress_.core_seconds_before = progress_.core_seconds_done;
}

bool Schedule::ready(std::size_t number) const {
  return states_[number] == State::waiting &&
         std::all_of(jobs_[number].needs.begin(), jobs_[number].needs.end(),
                     [&](std::size_t needed) { return states_[needed] == State::done; });
}

std::optional<CrewJobs::Job> Schedule::next() {
  if (cancelled()) return std::nullopt;
  const std::scoped_lock lock(mutex_);
  while (first_waiting_ < jobs_.size() && states_[first_waiting_] != State::waiting) ++first_waiting_;
  for (std::size_t i = first_waiting_; i < jobs_.size(); ++i) {
    if (!ready(i)) continue;
    std::string work = encode(work_of(jobs_[i].key));
    states_[i] = State::out;
    return Job{i, std::move(work)};
  }
  return std::nullopt;
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
  const std::scoped_lock lock(mutex_);
  if (states_[number] == State::done) return;
  store_.write(jobs_[number].key, rows);
  states_[number] = State::done;
  ++progress_.done;
  progress_.core_seconds_done += jobs_[number].core_seconds;
  progress_.job = describe(store_.options(), jobs_[number].key);
  progress_.job_seconds = seconds_of(rows);
  observer_.finished(progress_);
}

void Schedule::give_back(std::size_t number) {
  const std::scoped_lock lock(mutex_);
  if (states_[number] != State::out) return;
  states_[number] = State::waiting;
  first_waiting_ = std::min(first_waiting_, number);
}

bool Schedule::ended() const {
  if (cancelled()) return true;
  const std::scoped_lock lock(mutex_);
  return progress_.done == jobs_.size();
}

// A cancelled study stays cancelled, whatever the observer answers later: its crews may have left.
bool Schedule::cancelled() const {
  if (!cancelled_ && observer_.cancelled()) cancelled_ = true;
  return cancelled_;
}

}  // namespace remodel
