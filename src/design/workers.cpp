#include "design/workers.h"

#include <algorithm>
#include <limits>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "design/judge.h"

namespace remodel {
namespace {

// A worker as it was before the job under way, which may be interrupted.
struct Before {
  Mesh mesh;
  RegenerationRule::Row row;
  bool checked;
  std::string evaluator;
};

struct Worker {
  std::unique_ptr<LivingMesh> living;
  WorkerState state;
  DesignProfile profile;  // of its last design
  std::unique_ptr<EvaluatorState> evaluator{};
  std::vector<Job*> jobs{};        // handed to it, in order
  std::optional<Before> before{};  // where finished designs are to be kept, and the last one is not
};

std::string bytes_of(const std::unique_ptr<EvaluatorState>& state) {
  return state ? state->bytes() : std::string();
}

std::size_t thread_count(const OptimiseOptions& options, std::size_t workers) {
  const std::size_t wanted =
      options.threads != 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  return std::min(wanted, workers);
}

}  // namespace

std::size_t worker_count(const OptimiseOptions& options, std::size_t population) {
  if (options.workers != 0) return options.workers;
  return options.strategy == MeshStrategy::pool ? population : 1;
}

std::size_t mesh_count(const OptimiseOptions& options, std::size_t population) {
  return worker_count(options, population) + (options.strategy == MeshStrategy::hub ? 1 : 0);
}

struct Workers::Crew {
  explicit Crew(const Evaluating& given)
      : evaluating(given),
        options(given.options),
        at_work(std::min(worker_count(options, given.population), given.population)),
        share((given.population + at_work - 1) / at_work),
        team(thread_count(options, worker_count(options, given.population))) {}

  void start_hub(Mesh mesh);
  Worker& add(WorkerState state, Mesh mesh);
  DesignProfile profile_of(std::span<const double> design) const {
    return DesignProfile(evaluating.space.outline(design));
  }
  bool has_hub() const { return options.strategy == MeshStrategy::hub; }
  bool regenerates() const { return options.strategy == MeshStrategy::regenerate; }
  Worker& nearest(const DesignProfile& design);
  void hand_out(std::vector<Job>& jobs);
  void evaluate(Worker& worker, Job& job) const;
  void evaluate_next(Worker& worker, Job& job) const;
  void fail_at_limit(Worker& worker, Job& job) const;

  Evaluating evaluating;
  const OptimiseOptions& options;
  std::size_t at_work;  // at most, in a generation
  std::size_t share;    // the most designs of a generation that one worker takes
  ThreadTeam team;
  std::optional<Hub> hub;
  std::vector<Worker> workers;
  std::size_t last = 0;
  // The hub's work since the last evaluation; it is counted with the next one.
  double hub_seconds = 0.0;
  bool hub_refreshed = false;
};

void Workers::Crew::start_hub(Mesh mesh) {
  hub.emplace(options, evaluating.space, evaluating.population, std::move(mesh));
}

Worker& Workers::Crew::add(WorkerState state, Mesh mesh) {
  DesignProfile profile = profile_of(state.design);
  const DesignSpace& space = evaluating.space;
  auto living = hub ? std::make_unique<TrialMesh>(options, space, *hub, std::move(mesh))
                    : std::make_unique<LivingMesh>(options, space, std::move(mesh), at_work);
  return workers.emplace_back(
      Worker{.living = std::move(living), .state = std::move(state), .profile = std::move(profile)});
}

Worker& Workers::Crew::nearest(const DesignProfile& design) {
  Worker* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Worker& worker : workers) {
    if (worker.state.evaluated >= share) continue;
    const double squared = squared_displacement(worker.profile, design);
    if (best != nullptr && squared >= least) continue;
    best = &worker;
    least = squared;
  }
  return *best;
}

// With nobody to choose from and nothing to decide, no design need be looked at.
void Workers::Crew::hand_out(std::vector<Job>& jobs) {
  for (Job& job : jobs) {
    const std::vector<double>& design = job.proposal.design;
    Worker* worker = &workers.front();
    if (workers.size() > 1 || regenerates()) {
      DesignProfile profile = profile_of(design);
      worker = &nearest(profile);
      job.squared_displacement = squared_displacement(worker->profile, profile);
      worker->profile = std::move(profile);
    }
    worker->state.design = design;
    ++worker->state.evaluated;
    if (job.finished)
      worker->state.full_adjustments += job.record.full_adjustment ? 1 : 0;
    else
      worker->jobs.push_back(&job);
    last = static_cast<std::size_t>(worker - workers.data());
    job.record.worker = last + 1;
  }
}

void Workers::Crew::evaluate(Worker& worker, Job& job) const {
  WorkerState& state = worker.state;
  if (regenerates()) job.tasks.generate = RegenerationRule::generate(job.squared_displacement, state.row);
  if (!std::exchange(state.checked, true)) job.tasks.check = std::max(job.tasks.check, Checked::quick);
  job.stopped = worker.living->step(job.proposal.design, job.tasks, job.record);
  if (job.stopped != Stopped::done) return;
  state.full_adjustments += job.record.full_adjustment ? 1 : 0;
  if (regenerates())
    state.row = RegenerationRule::after(state.row, job.record.full_adjustment, job.tasks.generate);
  job.stopped = judge(evaluating, *worker.living, worker.evaluator, job);
}

void Workers::Crew::evaluate_next(Worker& worker, Job& job) const {
  if (options.keep_finished)
    worker.before.emplace(
        Before{worker.living->mesh(), worker.state.row, worker.state.checked, bytes_of(worker.evaluator)});
  evaluate(worker, job);
  const bool is_limit = job.stopped != Stopped::done && job.stopped != Stopped::interrupted;
  if (is_limit && worker.before && options.fail_at_limits) fail_at_limit(worker, job);
  job.finished = job.stopped == Stopped::done;
  if (job.finished) worker.before.reset();
}

// The next design goes on from the mesh before this one, of which no flow is known any more.
void Workers::Crew::fail_at_limit(Worker& worker, Job& job) const {
  worker.living->take_back(std::move(worker.before->mesh), job.record);
  worker.state.row = worker.before->row, worker.state.checked = worker.before->checked;
  worker.evaluator.reset();
  fail(job, at_limit(job.stopped));
  job.stopped = Stopped::done;
}

Workers::Workers(const Evaluating& evaluating, const Mesh& mesh) : crew_(std::make_unique<Crew>(evaluating)) {
  if (crew_->has_hub()) crew_->start_hub(mesh);
  for (std::size_t i = 0; i < worker_count(evaluating.options, evaluating.population); ++i)
    crew_->add({.design = first_design(evaluating.space, evaluating.options)}, mesh);
}

Workers::Workers(const Evaluating& evaluating, const WorkersState& state, std::vector<Mesh> meshes,
                 const std::string& source)
    : crew_(std::make_unique<Crew>(evaluating)) {
  if (crew_->has_hub()) crew_->start_hub(std::move(meshes.back()));
  for (std::size_t i = 0; i < state.workers.size(); ++i) {
    Worker& worker = crew_->add(state.workers[i], std::move(meshes[i]));
    const std::string& bytes = worker.state.evaluator;
    if (!bytes.empty()) worker.evaluator = evaluating.evaluator.restore(bytes, worker.living->mesh(), source);
  }
  crew_->last = state.last;
}

Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;

std::size_t Workers::count() const {
  return crew_->workers.size();
}

void Workers::begin_generation(const std::optional<std::vector<double>>& centre) {
  Hub::Generation before;
  for (Worker& worker : crew_->workers) {
    before.evaluated += std::exchange(worker.state.evaluated, 0);
    before.full_adjustments += std::exchange(worker.state.full_adjustments, 0);
  }
  if (!crew_->hub || !centre) return;
  const ThreadStopwatch watch;
  crew_->hub_refreshed |= crew_->hub->follow(*centre, before);
  crew_->hub_seconds += watch.seconds();
}

void Workers::evaluate(std::vector<Job>& jobs) {
  if (jobs.empty()) return;
  crew_->hand_out(jobs);
  std::vector<Worker*> busy;
  for (Worker& worker : crew_->workers)
    if (!worker.jobs.empty()) busy.push_back(&worker);
  crew_->team.run(busy.size(), [&](std::size_t i) {
    for (Job* job : std::exchange(busy[i]->jobs, {})) {
      crew_->evaluate_next(*busy[i], *job);
      if (!job->finished) return;
    }
  });
  jobs.front().record.remodel_seconds += std::exchange(crew_->hub_seconds, 0.0);
  jobs.front().record.refreshed |= std::exchange(crew_->hub_refreshed, false);
}

const Mesh& Workers::last_mesh() const {
  return crew_->workers[crew_->last].living->mesh();
}

std::vector<const Mesh*> Workers::meshes() const {
  std::vector<const Mesh*> result;
  for (const Worker& worker : crew_->workers) result.push_back(&worker.living->mesh());
  if (crew_->hub) result.push_back(&crew_->hub->mesh());
  return result;
}

WorkersState Workers::state() const {
  WorkersState result{.workers = {}, .last = crew_->last};
  for (const Worker& worker : crew_->workers) {
    WorkerState& state = result.workers.emplace_back(worker.state);
    state.evaluator = bytes_of(worker.evaluator);
  }
  return result;
}

KeptWorkers Workers::kept(WorkersState before, std::span<const Job> first) const {
  KeptWorkers result{.state = std::move(before), .meshes = meshes()};
  for (const Job& job : first) {
    result.state.last = job.record.worker - 1;
    WorkerState& state = result.state.workers[result.state.last];
    state.design = job.proposal.design;
    ++state.evaluated;
    state.full_adjustments += job.record.full_adjustment ? 1 : 0;
  }
  for (std::size_t i = 0; i < crew_->workers.size(); ++i) {
    const Worker& worker = crew_->workers[i];
    WorkerState& state = result.state.workers[i];
    if (worker.before) {
      result.meshes[i] = &worker.before->mesh;
      state.row = worker.before->row, state.checked = worker.before->checked;
      state.evaluator = worker.before->evaluator;
    } else {
      state.row = worker.state.row, state.checked = worker.state.checked;
      state.evaluator = bytes_of(worker.evaluator);
    }
  }
  return result;
}

}  // namespace remodel
