// A sweep's session: a crew does the chains that are not finished, and the tables are made of all that are.

#include <algorithm>
#include <atomic>
#include <mutex>

#include "aero/sweep_directory.h"
#include "aero/sweep_table.h"
#include "base/stopwatch.h"
#include "remodel/directory_lock.h"
#include "remodel/error.h"
#include "remodel/sweep.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

class SweepJobs final : public CrewJobs {
 public:
  // From now on the directory is used only under this object's lock.
  SweepJobs(const SweepDirectory& directory, SweepObserver& observer)
      : directory_(directory),
        observer_(observer),
        chains_(directory.chains()),
        states_(chains_.size(), State::waiting) {
    progress_.chains = chains_.size();
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      progress_.flows += chains_[i].flows();
      if (directory_.is_finished(i)) note(i, directory_.read(i));
    }
    progress_.flows_before = progress_.flows_done;
  }

  std::optional<Job> next() override {
    if (cancelled()) return std::nullopt;
    const std::scoped_lock lock(mutex_);
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      if (states_[i] != State::waiting) continue;
      states_[i] = State::out;
      return Job{i, encode(directory_.work_of(chains_[i]))};
    }
    return std::nullopt;
  }
  void finish(std::size_t number, const std::string& bytes) override {
    const std::scoped_lock lock(mutex_);
    if (states_[number] == State::done) return;
    const ChainResult result = decode_chain_result(bytes, "result of a chain");
    directory_.write(number, bytes);
    note(number, result);
    observer_.finished(progress_);
  }
  void give_back(std::size_t number) override {
    const std::scoped_lock lock(mutex_);
    if (states_[number] == State::out) states_[number] = State::waiting;
  }
  bool ended() const override {
    if (cancelled()) return true;
    const std::scoped_lock lock(mutex_);
    return progress_.chains_done == progress_.chains;
  }
  // A cancelled sweep stays cancelled, whatever the observer answers later: its crew may have left.
  bool cancelled() const override {
    if (!cancelled_ && observer_.cancelled()) cancelled_ = true;
    return cancelled_;
  }

  const SweepProgress& progress() const { return progress_; }

 private:
  enum class State { waiting, out, done };
  void note(std::size_t number, const ChainResult& result) {
    states_[number] = State::done;
    ++progress_.chains_done;
    progress_.flows_done += result.flows.size();
    for (const SweepFlow& flow : result.flows) progress_.found += flow.point.converged;
  }

  mutable std::mutex mutex_;
  const SweepDirectory& directory_;
  SweepObserver& observer_;
  std::vector<PlannedChain> chains_;
  std::vector<State> states_;
  SweepProgress progress_;
  mutable std::atomic<bool> cancelled_ = false;
};

// is_ours: the directory was made for this sweep, and is gone again if it cannot begin.
SweepDirectory opened(const fs::path& directory, const SweepProblem& problem, SweepMode mode, bool is_ours) {
  if (mode == SweepMode::begin) {
    SweepDirectory::require_new(directory);  // again, now that the lock keeps others from beginning
    try {
      return {directory, problem};
    } catch (...) {
      std::error_code ignored;
      if (is_ours) fs::remove(directory, ignored);
      throw;
    }
  }
  SweepDirectory sweep(directory);
  sweep.extend(problem);
  return sweep;
}

// The flows of all finished chains, in the order of the table.
struct Finished {
  std::vector<SweepFlow> flows;
  double mesh_seconds = 0.0;
};

Finished finished_of(const SweepDirectory& directory) {
  Finished finished;
  const std::size_t chains = directory.chains().size();
  for (std::size_t i = 0; i < chains; ++i) {
    if (!directory.is_finished(i)) continue;
    ChainResult result = directory.read(i);
    finished.mesh_seconds += result.mesh_seconds;
    std::move(result.flows.begin(), result.flows.end(), std::back_inserter(finished.flows));
  }
  const auto place = [](const SweepFlow& flow) {
    return std::tuple(flow.section, flow.mach, flow.reynolds, flow.asked);
  };
  std::sort(finished.flows.begin(), finished.flows.end(),
            [&](const SweepFlow& a, const SweepFlow& b) { return place(a) < place(b); });
  return finished;
}

void add_costs(const Finished& finished, SweepResult& result) {
  double cold_seconds = 0.0;
  std::size_t cold = 0;
  for (const SweepFlow& flow : finished.flows) {
    result.found += flow.point.converged;
    result.flow_seconds += flow.point.seconds;
    if (!flow.point.converged || flow.point.start != FlowStart::cold) continue;
    cold_seconds += flow.point.seconds;
    ++cold;
  }
  result.flows = finished.flows.size();
  result.not_found = result.flows - result.found;
  result.mesh_seconds = finished.mesh_seconds;
  if (cold != 0)
    result.cold_seconds_estimate =
        cold_seconds / static_cast<double>(cold) * static_cast<double>(result.flows);
}

}  // namespace

const char* name_of(SweepOrder order) {
  switch (order) {
    case SweepOrder::nearest:
      return "nearest";
    case SweepOrder::given:
      return "given";
    case SweepOrder::random:
      return "random";
  }
  return "";
}

const char* status_of(const SweepFlow& flow) {
  if (flow.refused) return "refused";
  return flow.point.status ? name_of(*flow.point.status) : "not-looked-for";
}

const char* name_of(SweepStopped stopped) {
  return stopped == SweepStopped::done ? "done" : "interrupted";
}

SweepResult sweep(const fs::path& directory, const SweepProblem& problem, SweepMode mode, Crew& crew,
                  SweepObserver* observer) {
  const Stopwatch watch;
  validate(problem, "sweep");
  if (mode == SweepMode::begin) SweepDirectory::require_new(directory);
  if (mode == SweepMode::resume) SweepDirectory ignored(directory);  // throws where there is none
  const bool is_missing = !fs::exists(directory);
  const DirectoryLock lock(directory);
  const SweepDirectory sweep = opened(directory, problem, mode, is_missing);
  lock.sync();
  SweepObserver silent;
  SweepJobs jobs(sweep, observer ? *observer : silent);
  crew.work(jobs, run_sweep_chain);

  const Finished finished = finished_of(sweep);
  write_sweep_tables(directory, sweep.problem(), finished.flows);
  lock.sync();
  SweepResult result;
  add_costs(finished, result);
  result.planned = jobs.progress().flows;
  result.sections = sweep.problem().sections.size();
  result.chains = jobs.progress().chains;
  result.stopped =
      jobs.progress().chains_done == jobs.progress().chains ? SweepStopped::done : SweepStopped::interrupted;
  result.seconds = watch.seconds();
  return result;
}

SweepProblem read_sweep_problem(const fs::path& directory) {
  return SweepDirectory(directory).problem();
}

std::vector<SweepFlow> read_sweep_flows(const fs::path& directory) {
  return finished_of(SweepDirectory(directory)).flows;
}

}  // namespace remodel
