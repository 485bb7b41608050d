// A sweep's session: a crew does the chains that are not finished, and the tables are made of all that are.

#include <algorithm>

#include "aero/sweep_directory.h"
#include "aero/sweep_table.h"
#include "base/stopwatch.h"
#include "design/job_queue.h"
#include "remodel/directory_lock.h"
#include "remodel/error.h"
#include "remodel/sweep.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

class SweepJobs final : public JobQueue {
 public:
  // From now on the directory is used only under this object's lock.
  SweepJobs(const SweepDirectory& directory, SweepObserver& observer)
      : JobQueue(directory.chains().size()),
        directory_(directory),
        observer_(observer),
        chains_(directory.chains()) {
    progress_.chains = chains_.size();
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      progress_.flows += chains_[i].flows();
      if (!directory_.is_finished(i)) continue;
      mark_done(i);
      note(directory_.read(i));
    }
    progress_.flows_before = progress_.flows_done;
  }

  void finish(std::size_t number, const std::string& bytes) override {
    const ChainResult result = decode_chain_result(bytes, "result of a chain");
    finish_once(number, [&] {
      directory_.write(number, bytes);
      note(result);
      observer_.finished(progress_);
    });
  }

  const SweepProgress& progress() const { return progress_; }

 private:
  std::string work_of(std::size_t number) const override {
    return encode(directory_.work_of(chains_[number]));
  }
  bool asks_to_cancel() const override { return observer_.cancelled(); }
  void note(const ChainResult& result) {
    ++progress_.chains_done;
    progress_.flows_done += result.flows.size();
    for (const SweepFlow& flow : result.flows) progress_.found += flow.point.converged;
  }

  const SweepDirectory& directory_;
  SweepObserver& observer_;
  std::vector<PlannedChain> chains_;
  SweepProgress progress_;
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

SweepCounts counts_of(const std::vector<SweepFlow>& flows) {
  SweepCounts counts;
  double cold_seconds = 0.0;
  std::size_t cold = 0;
  for (const SweepFlow& flow : flows) {
    counts.found += flow.point.converged;
    counts.warned += flow.point.converged && !flow.point.warnings.empty();
    counts.seconds += flow.point.seconds;
    if (!flow.point.converged || flow.point.start != FlowStart::cold) continue;
    cold_seconds += flow.point.seconds;
    ++cold;
  }
  if (cold != 0)
    counts.cold_seconds_estimate =
        cold_seconds / static_cast<double>(cold) * static_cast<double>(flows.size());
  return counts;
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
  if (mode == SweepMode::resume) SweepDirectory::require_there(directory);
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
  const SweepCounts counts = counts_of(finished.flows);
  SweepResult result;
  result.flows = finished.flows.size();
  result.found = counts.found;
  result.not_found = result.flows - counts.found;
  result.flow_seconds = counts.seconds;
  result.mesh_seconds = finished.mesh_seconds;
  result.cold_seconds_estimate = counts.cold_seconds_estimate.value_or(0.0);
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
