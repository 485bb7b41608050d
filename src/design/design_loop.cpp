#include "design/design_loop.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/checksum.h"
#include "base/stopwatch.h"
#include "design/checkpoint.h"
#include "design/comparison.h"
#include "design/design_search.h"
#include "design/living_mesh.h"
#include "design/record_checksum.h"
#include "design/run_directory.h"
#include "design/run_mesh.h"
#include "design/settings.h"
#include "design/summary.h"
#include "design/workers.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/version.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

// Whether something that is due every k evaluations, 0 for never, is due.
bool every(std::size_t k, std::uint64_t evaluation) {
  return k != 0 && evaluation % k == 0;
}

// The boxes of the start's file stay with the run's meshes.
WriteOptions boxes_of(const OptimiseOptions& options) {
  return {.su2_boxes = options.start ? options.start->su2_boxes : std::string()};
}

// Who waits for an evaluation asks the run's observer. A crew that has failed ends the run too.
class CancelQuestion final : public StepObserver {
 public:
  CancelQuestion(OptimiseObserver& observer, const PostedJobs* ranks) : observer_(observer), ranks_(ranks) {}
  bool cancelled() override { return observer_.cancelled() || (ranks_ != nullptr && ranks_->failed()); }

 private:
  OptimiseObserver& observer_;
  const PostedJobs* ranks_;
};

Feasible feasible_in(const DesignSpace& space) {
  return [&space, dimension = space.start().size()](std::span<const double> design) {
    if (design.size() != dimension)
      throw Error(ErrorCode::argument, "designer",
                  "found a design of " + std::to_string(design.size()) + " parameters, expected " +
                      std::to_string(dimension));
    return space.feasible(design);
  };
}

// All that changes as a run goes on, but for the designer.
struct Progress {
  RunDirectory directory;
  Workers workers;
  History history;
  Summary summary;
  Checksum written{};                                  // of the history
  std::uint64_t refused = 0;                           // infeasible samples since the last evaluation
  std::map<std::uint64_t, FinishedDesign> ahead = {};  // finished before an interrupt, by evaluation
  double earlier_seconds = 0.0;
};

class Run {
 public:
  Run(Progress progress, const LoopParts& problem, const OptimiseOptions& options)
      : progress_(std::move(progress)),
        problem_(problem),
        options_(options),
        population_(problem.designer.population()),
        feasible_(feasible_in(problem.space)),
        settings_(settings_of(problem.space, problem.designer, problem.evaluator, options)) {}

  OptimiseStopped evaluate_all(OptimiseObserver& observer);
  OptimiseResult finish(OptimiseStopped stopped);

 private:
  OptimiseStopped evaluate_some(OptimiseObserver& observer);
  bool begins_generation() const { return evaluations() % population_ == 0; }
  void remember();
  void begin_generation();
  std::size_t at_once() const;
  Job job_of(const Sample& sample, std::uint64_t evaluation);
  void complete(const Sample& sample, Job& job);
  StepTasks tasks(const Proposal& proposal, std::uint64_t evaluation) const;
  bool checkpoint_due() const;
  Checkpoint present_checkpoint() const;
  OptimiseStopped stop_within(std::vector<Sample>& samples, std::vector<Job>& jobs,
                              OptimiseObserver& observer);
  void go_back_to(std::size_t finished);
  void keep_finished(std::span<const Job> jobs, std::size_t first);
  void write(const Checkpoint& checkpoint, std::span<const Mesh* const> meshes);
  void checkpoint();
  void write_last_mesh(const char* name) const;
  std::uint64_t evaluations() const { return progress_.summary.evaluations(); }
  std::uint64_t middle() const { return (options_.evaluations + 1) / 2; }
  bool generation_ends() const { return evaluations() != 0 && evaluations() % population_ == 0; }
  bool finished() const;
  bool is_middle() const;
  double seconds() const { return progress_.earlier_seconds + watch_.seconds(); }

  Stopwatch watch_;
  Stopwatch since_checkpoint_;
  Progress progress_;
  const LoopParts& problem_;
  const OptimiseOptions& options_;
  std::size_t population_;
  Feasible feasible_;
  std::string settings_;
  bool mesh_is_of_last_row_ = true;
  std::string limit_;  // of a mesh, that ended the run
  // What was there before the evaluations under way.
  struct Before {
    std::string designer;
    WorkersState workers;
    bool begins = false;        // a generation
    std::optional<Mesh> hub{};  // which goes on where a generation begins
  };
  std::optional<Before> before_;
  // What can be gone on from where one of them was interrupted.
  struct Kept {
    Checkpoint checkpoint;
    std::vector<const Mesh*> meshes;
  };
  std::optional<Kept> kept_;
};

OptimiseStopped Run::evaluate_all(OptimiseObserver& observer) {
  while (!finished()) {
    if (observer.cancelled()) return OptimiseStopped::interrupted;
    if (const OptimiseStopped stopped = evaluate_some(observer); stopped != OptimiseStopped::done)
      return stopped;
  }
  return OptimiseStopped::done;
}

// The tolerance ends a run at a generation's end alone: how many designs are evaluated at once then changes
// nothing.
bool Run::finished() const {
  if (evaluations() >= options_.evaluations || problem_.designer.finished()) return true;
  return options_.tolerance != 0.0 && generation_ends() &&
         progress_.summary.best_objective() <= options_.tolerance;
}

bool Run::is_middle() const {
  const Summary& summary = progress_.summary;
  if (options_.tolerance == 0.0 || !problem_.half_way) return evaluations() == middle();
  if (evaluations() > middle() || summary.best_before_generation() <= *problem_.half_way) return false;
  return evaluations() == middle() || (generation_ends() && summary.best_objective() <= *problem_.half_way);
}

// The number of designs that are evaluated at once: all of one generation, up to the next mesh or checkpoint
// that is written. A single worker takes one at a time.
std::size_t Run::at_once() const {
  if (progress_.workers.count() == 1) return 1;
  const std::uint64_t done = evaluations();
  std::uint64_t number = std::min(population_ - done % population_, options_.evaluations - done);
  if (options_.checkpoint_every != 0)
    number = std::min(number, options_.checkpoint_every - done % options_.checkpoint_every);
  if (done < middle()) number = std::min(number, middle() - done);
  return number;
}

OptimiseStopped Run::evaluate_some(OptimiseObserver& observer) {
  if (options_.keep_finished) remember();
  if (begins_generation()) begin_generation();
  std::vector<Sample> samples;
  std::vector<Job> jobs;
  const std::size_t wanted = at_once();
  while (jobs.size() < wanted) {
    std::optional<Sample> sample = next_sample(problem_.designer, feasible_, options_.max_refused);
    if (!sample) break;
    jobs.push_back(job_of(*sample, evaluations() + jobs.size() + 1));
    samples.push_back(std::move(*sample));
  }
  progress_.workers.evaluate(jobs);
  mesh_is_of_last_row_ = std::all_of(jobs.begin(), jobs.end(), [](const Job& job) { return job.finished; });
  if (!mesh_is_of_last_row_) return stop_within(samples, jobs, observer);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    complete(samples[i], jobs[i]);
    observer.evaluated(jobs[i].record);
  }
  if (jobs.size() < wanted && problem_.designer.finished()) return OptimiseStopped::done;
  if (jobs.size() < wanted) {
    progress_.refused += options_.max_refused;
    return OptimiseStopped::infeasible;
  }
  if (is_middle()) write_last_mesh("middle.vtkhdf");
  if (checkpoint_due()) checkpoint();
  return OptimiseStopped::done;
}

// Of the designs that were evaluated at once, one or more were not finished: those before the first of them
// are completed, and those behind it kept.
OptimiseStopped Run::stop_within(std::vector<Sample>& samples, std::vector<Job>& jobs,
                                 OptimiseObserver& observer) {
  const auto unfinished =
      std::find_if(jobs.begin(), jobs.end(), [](const Job& job) { return !job.finished; });
  const auto first = static_cast<std::size_t>(unfinished - jobs.begin());
  if (options_.keep_finished) go_back_to(first);
  for (std::size_t i = 0; i < first; ++i) {
    complete(samples[i], jobs[i]);
    observer.evaluated(jobs[i].record);
  }
  if (options_.keep_finished) keep_finished(jobs, first);
  if (unfinished->stopped != Stopped::interrupted)
    limit_ = "evaluation " + std::to_string(evaluations() + 1) + ": " + at_limit(unfinished->stopped);
  return unfinished->stopped == Stopped::interrupted ? OptimiseStopped::interrupted
                                                     : OptimiseStopped::mesh_limit;
}

// The designer as if it had been asked for so many designs alone. Where there are none, its state from before
// is all that is asked for.
void Run::go_back_to(std::size_t finished) {
  if (finished == 0) return;
  problem_.designer.restore(before_->designer, "designer");
  for (std::size_t i = 0; i < finished; ++i) next_sample(problem_.designer, feasible_, options_.max_refused);
}

void Run::keep_finished(std::span<const Job> jobs, std::size_t first) {
  for (const Job& job : jobs.subspan(first))
    if (job.finished) progress_.ahead[job.record.evaluation] = {job.record, job.evaluation};
  WorkersState before = before_->workers;
  if (first != 0 && before_->begins)
    for (WorkerState& worker : before.workers) worker.evaluated = worker.full_adjustments = 0;
  KeptWorkers workers = progress_.workers.kept(std::move(before), jobs.first(first));
  if (first == 0 && before_->hub) workers.meshes.back() = &*before_->hub;
  Checkpoint checkpoint = present_checkpoint();
  if (first == 0) checkpoint.designer = before_->designer;
  checkpoint.workers = std::move(workers.state);
  kept_.emplace(Kept{std::move(checkpoint), std::move(workers.meshes)});
}

void Run::remember() {
  before_.emplace(Before{.designer = problem_.designer.state(),
                         .workers = progress_.workers.state(),
                         .begins = begins_generation()});
  if (before_->begins && options_.strategy == MeshStrategy::hub)
    before_->hub = *progress_.workers.meshes().back();
}

void Run::begin_generation() {
  const bool hub = options_.strategy == MeshStrategy::hub;
  progress_.workers.begin_generation(hub ? feasible_centre(problem_.designer, feasible_) : std::nullopt);
}

// One that was finished before an interrupt is so still.
Job Run::job_of(const Sample& sample, std::uint64_t evaluation) {
  Job job{.proposal = sample.proposal, .tasks = tasks(sample.proposal, evaluation)};
  job.record.evaluation = evaluation;
  job.record.generation = problem_.designer.generation();
  job.record.coefficients = sample.proposal.design;
  job.record.sigma = problem_.designer.step_size();
  const auto found = progress_.ahead.find(evaluation);
  if (found == progress_.ahead.end()) return job;
  job.record = std::move(found->second.record);
  job.evaluation = std::move(found->second.evaluation);
  job.finished = true;
  progress_.ahead.erase(found);
  return job;
}

// Completes the row of an evaluation and tells everybody.
void Run::complete(const Sample& sample, Job& job) {
  EvaluationRecord& record = job.record;
  record.best_objective =
      progress_.summary.is_better(record) ? record.objective : progress_.summary.best_objective();
  record.infeasible_samples = progress_.refused + sample.refused;
  progress_.refused = 0;
  problem_.designer.tell(job.proposal, job.evaluation);
  progress_.history.append(record);
  progress_.summary.add(record);
  add(progress_.written, record);
}

// The changes of a step are always checked, the whole mesh now and then and at each worker's first step. So
// every triangle that ever was is checked once, and the smallest of all angles is known.
StepTasks Run::tasks(const Proposal& proposal, std::uint64_t evaluation) const {
  constexpr std::size_t quick_check_every = 20;
  const std::size_t full_check_every =
      options_.full_check_every != 0 ? options_.full_check_every : options_.compare_every;
  StepTasks tasks{.check = every(full_check_every, evaluation)    ? Checked::full
                           : every(quick_check_every, evaluation) ? Checked::quick
                                                                  : Checked::changes};
  if (every(options_.compare_every, evaluation))
    tasks.compare =
        compared_design(problem_.space, proposal.design, evaluation, problem_.designer.step_size());
  return tasks;
}

// Where evaluations are long, hundreds of them are too much to lose.
bool Run::checkpoint_due() const {
  constexpr double seconds_between = 60.0;
  return every(options_.checkpoint_every, evaluations()) ||
         (options_.checkpoint_every != 0 && since_checkpoint_.seconds() >= seconds_between);
}

Checkpoint Run::present_checkpoint() const {
  std::vector<FinishedDesign> ahead;
  for (const auto& [evaluation, design] : progress_.ahead) ahead.push_back(design);
  return {.settings = settings_,
          .evaluation = evaluations(),
          .refused = progress_.refused,
          .finished = finished(),
          .seconds = seconds(),
          .designer = problem_.designer.state(),
          .workers = progress_.workers.state(),
          .ahead = std::move(ahead),
          .history_checksum = progress_.written.text()};
}

// The history first: a checkpoint never stands for rows that are not on disk.
void Run::write(const Checkpoint& checkpoint, std::span<const Mesh* const> meshes) {
  progress_.history.commit();
  write_checkpoint(options_.directory, checkpoint, meshes);
  since_checkpoint_ = Stopwatch();
}

void Run::checkpoint() {
  write(present_checkpoint(), progress_.workers.meshes());
}

void Run::write_last_mesh(const char* name) const {
  write_run_mesh(problem_.space, progress_.workers.last_mesh(), progress_.workers.design_of_last_mesh(),
                 options_.directory / name, boxes_of(options_));
}

// Where the meshes are not those of the last row, those kept before may be; otherwise the checkpoint before
// is what can be gone on from.
OptimiseResult Run::finish(OptimiseStopped stopped) {
  progress_.history.commit();
  if (mesh_is_of_last_row_) {
    write_last_mesh("last.vtkhdf");
    checkpoint();
  } else if (kept_) {
    const WorkersState& workers = kept_->checkpoint.workers;
    write_run_mesh(problem_.space, *kept_->meshes[workers.last],
                   workers.workers[workers.last].design_of_mesh(), options_.directory / "last.vtkhdf",
                   boxes_of(options_));
    write(kept_->checkpoint, kept_->meshes);
  }
  OptimiseResult result = progress_.summary.result();
  if (!limit_.empty()) result.detail += (result.detail.empty() ? "" : "; ") + limit_;
  result.infeasible_samples += progress_.refused;
  result.stopped = stopped;
  result.workers = progress_.workers.count();
  if (result.best_design.empty()) result.best_design = problem_.space.start();
  if (problem_.complete) problem_.complete(result);
  result.seconds = seconds();
  write_text_atomically(options_.directory / "best.json", problem_.space.text(result.best_design));
  write_text_atomically(options_.directory / "result.json", optimise_result_to_json(result) + "\n");
  return result;
}

// A history of evaluations is a run too, whatever became of its checkpoint. That of a start that was killed
// has none.
bool has_evaluations(const fs::path& history) {
  if (!fs::exists(history)) return false;
  bool any = false;
  History::open(history).each([&](const EvaluationRecord&) { any = true; });
  return any;
}

// The start of a run, complete on the disk before it replaces what the directory holds.
Progress begin(const LoopParts& problem, const Evaluating& evaluating, RunDirectory directory,
               const Mesh& mesh) {
  const OptimiseOptions& options = evaluating.options;
  Workers workers(evaluating, mesh);
  std::map<std::string, std::string> run = problem.facts;
  run["version"] = REMODEL_VERSION;
  run["options"] = settings_of(problem.space, problem.designer, problem.evaluator, options);
  Checksum written;
  add(written, run);
  try {
    const fs::path start = directory.make_start();
    write_run_mesh(problem.space, mesh, first_design(problem.space, options), start / "first.vtkhdf",
                   boxes_of(options));
    History::create(start / "history.sqlite", run);
    const std::vector<const Mesh*> everywhere(mesh_count(options, evaluating.population), &mesh);
    write_checkpoint(start,
                     {.settings = run.at("options"),
                      .designer = problem.designer.state(),
                      .workers = workers.state(),
                      .history_checksum = written.text()},
                     everywhere);
    directory.publish_start();
  } catch (...) {
    directory.drop_start();
    throw;
  }
  History history = History::resume(options.directory / "history.sqlite", 0);
  return {.directory = std::move(directory),
          .workers = std::move(workers),
          .history = std::move(history),
          .summary = Summary(options.constraint_tolerance),
          .written = written};
}

// The first rows of the history as the checkpoint knows them. Whatever a damaged file may hold, it is refused
// before it is written to.
Summary replay(const fs::path& file, const Checkpoint& checkpoint, const LoopParts& problem,
               const OptimiseOptions& options, Checksum& written) {
  const History history = History::open(file);
  const std::map<std::string, std::string> run = history.run();
  const auto stored = run.find("options");
  require_settings(stored == run.end() ? "" : stored->second, checkpoint.settings, file.parent_path());
  add(written, run);
  const std::size_t dimension = problem.space.start().size();
  Summary summary(options.constraint_tolerance);
  history.each([&](const EvaluationRecord& record) {
    if (record.evaluation > checkpoint.evaluation) return;
    if (record.coefficients.size() != dimension)
      throw Error(ErrorCode::format, file.string(),
                  "expected " + std::to_string(dimension) + " coefficients, found " +
                      std::to_string(record.coefficients.size()));
    add(written, record);
    summary.add(record);
  });
  if (summary.evaluations() != checkpoint.evaluation || written.text() != checkpoint.history_checksum)
    throw Error(ErrorCode::format, file.string(),
                "expected the history of checkpoint.json: its checksum is another");
  return summary;
}

Workers restored_workers(const Evaluating& evaluating, const Checkpoint& checkpoint, std::size_t dimension) {
  const OptimiseOptions& options = evaluating.options;
  const std::string source = (options.directory / "checkpoint.json").string();
  std::vector<Mesh> meshes = read_checkpoint_meshes(options.directory);
  const std::size_t workers = worker_count(options, evaluating.population);
  const auto fits = [&](const WorkerState& worker) { return worker.design.size() == dimension; };
  const std::vector<WorkerState>& states = checkpoint.workers.workers;
  if (states.size() != workers || meshes.size() != mesh_count(options, evaluating.population) ||
      !std::all_of(states.begin(), states.end(), fits))
    throw Error(ErrorCode::format, source,
                "expected " + std::to_string(workers) + " workers with a mesh and " +
                    std::to_string(dimension) + " coefficients each");
  return Workers(evaluating, checkpoint.workers, std::move(meshes), source);
}

std::map<std::uint64_t, FinishedDesign> by_evaluation(const std::vector<FinishedDesign>& designs) {
  std::map<std::uint64_t, FinishedDesign> result;
  for (const FinishedDesign& design : designs) result[design.record.evaluation] = design;
  return result;
}

Progress go_on(const LoopParts& problem, const Evaluating& evaluating) {
  const OptimiseOptions& options = evaluating.options;
  if (!has_checkpoint(options.directory)) read_checkpoint(options.directory);  // says that it is missing
  RunDirectory directory(options.directory);
  const fs::path history_file = options.directory / "history.sqlite";
  const Checkpoint checkpoint = read_checkpoint(options.directory);
  require_settings(checkpoint.settings,
                   settings_of(problem.space, problem.designer, problem.evaluator, options),
                   options.directory);
  problem.designer.restore(checkpoint.designer, (options.directory / "checkpoint.json").string());
  const std::size_t dimension = problem.space.start().size();
  Workers workers = restored_workers(evaluating, checkpoint, dimension);
  Checksum written;
  Summary summary = replay(history_file, checkpoint, problem, options, written);
  return {.directory = std::move(directory),
          .workers = std::move(workers),
          .history = History::resume(history_file, checkpoint.evaluation),
          .summary = std::move(summary),
          .written = written,
          .refused = checkpoint.refused,
          .ahead = by_evaluation(checkpoint.ahead),
          .earlier_seconds = checkpoint.seconds};
}

OptimiseResult without_start(const LoopParts& problem, const OptimiseOptions& options, Stopped stopped) {
  OptimiseResult result;
  result.stopped =
      stopped == Stopped::interrupted ? OptimiseStopped::interrupted : OptimiseStopped::mesh_limit;
  result.workers = worker_count(options, problem.designer.population());
  result.best_design = problem.space.start();
  if (problem.complete) problem.complete(result);
  return result;
}

}  // namespace

void require_no_other_run(const fs::path& directory) {
  if (!has_checkpoint(directory)) {
    if (has_evaluations(directory / "history.sqlite"))
      throw Error(
          ErrorCode::argument, directory.string(),
          "holds the history of a run without its checkpoint: expected another directory, or --overwrite "
          "to replace it");
    return;
  }
  const Checkpoint other = read_checkpoint(directory);
  throw Error(ErrorCode::argument, directory.string(),
              "holds " + std::string(other.finished ? "a finished run" : "an unfinished run") + " of " +
                  std::to_string(other.evaluation) +
                  " evaluations: expected another directory, --resume to go on with it, or --overwrite to "
                  "replace it");
}

OptimiseResult run_design_loop(const LoopParts& problem, const OptimiseOptions& options,
                               OptimiseObserver* observer) {
  require_good(options);
  OptimiseObserver silent;
  OptimiseObserver& listener = observer ? *observer : silent;
  CancelQuestion question(listener, options.ranks);
  const Evaluating evaluating{.space = problem.space,
                              .evaluator = problem.evaluator,
                              .options = options,
                              .population = problem.designer.population(),
                              .observer = question};
  if (options.resume) {
    Run run(go_on(problem, evaluating), problem, options);
    return run.finish(run.evaluate_all(listener));
  }
  // A directory that exists is locked before it is looked at; a new one is made only for a run that can
  // start.
  std::optional<RunDirectory> directory;
  if (fs::exists(options.directory)) {
    directory.emplace(options.directory);
    if (!options.overwrite) require_no_other_run(options.directory);
  }
  const GenerateResult first = first_mesh(problem.space, options, &question);
  if (first.stopped != Stopped::done) return without_start(problem, options, first.stopped);
  if (!directory) directory.emplace(options.directory);
  if (!options.overwrite) require_no_other_run(options.directory);
  Run run(begin(problem, evaluating, std::move(*directory), first.mesh), problem, options);
  return run.finish(run.evaluate_all(listener));
}

}  // namespace remodel
