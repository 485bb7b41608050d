#include "design/workers.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "design/crew_states.h"
#include "design/judge.h"
#include "design/posted_design.h"
#include "design/run_mesh.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// A worker as it was before the job under way, which may be interrupted.
struct Before {
  Mesh mesh;
  std::vector<double> design;  // of the mesh
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
  std::uint64_t token = 0;         // of its last job that a crew has done
};

// What an evaluator keeps in another process, as bytes.
struct StateElsewhere final : EvaluatorState {
  explicit StateElsewhere(std::string of) : text(std::move(of)) {}
  std::string bytes() const override { return text; }
  std::string text;
};

std::string bytes_of(const std::unique_ptr<EvaluatorState>& state) {
  return state ? state->bytes() : std::string();
}

// WorkerState::mesh_design.
std::vector<double> design_kept(const WorkerState& state, const std::vector<double>& design) {
  return design == state.design ? std::vector<double>() : design;
}

std::size_t thread_count(const OptimiseOptions& options, std::size_t workers) {
  if (options.ranks != nullptr) return workers;  // each waits for a job of its own
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
        team(thread_count(options, worker_count(options, given.population))) {
    if (options.ranks != nullptr) run = identity_of(given.space, given.evaluator);
  }

  void start_hub(Mesh mesh);
  Worker& add(WorkerState state, Mesh mesh);
  DesignProfile profile_of(std::span<const double> design) const {
    return DesignProfile(evaluating.space.outline(design));
  }
  bool has_hub() const { return options.strategy == MeshStrategy::hub; }
  bool regenerates() const { return options.strategy == MeshStrategy::regenerate; }
  std::unique_ptr<LivingMesh> living_around(Mesh mesh, std::vector<double> design) const;
  Worker& nearest(const DesignProfile& design);
  void hand_out(std::vector<Job>& jobs);
  void evaluate(Worker& worker, Job& job) const;
  void evaluate_elsewhere(Worker& worker, Job& job) const;
  void evaluate_next(Worker& worker, Job& job) const;
  void fail_at_limit(Worker& worker, Job& job) const;

  Evaluating evaluating;
  const OptimiseOptions& options;
  std::size_t at_work;  // at most, in a generation
  std::size_t share;    // the most designs of a generation that one worker takes
  ThreadTeam team;
  std::string run{};  // PostedDesign::run, where ranks evaluate
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
  return workers.emplace_back(Worker{.living = living_around(std::move(mesh), state.design_of_mesh()),
                                     .state = std::move(state),
                                     .profile = std::move(profile)});
}

std::unique_ptr<LivingMesh> Workers::Crew::living_around(Mesh mesh, std::vector<double> design) const {
  const DesignSpace& space = evaluating.space;
  return hub ? std::make_unique<TrialMesh>(options, space, *hub, std::move(mesh), std::move(design))
             : std::make_unique<LivingMesh>(options, space, std::move(mesh), std::move(design), at_work);
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

// The worker's mesh, and what it knows, go to the process that does its jobs and come back.
void Workers::Crew::evaluate_elsewhere(Worker& worker, Job& job) const {
  PostedDesign design{.run = run,
                      .worker = job.record.worker,
                      .token = options.ranks->new_token(),
                      .before = worker.token,
                      .state = worker.state,
                      .meshes = {},
                      .proposal = job.proposal,
                      .tasks = job.tasks,
                      .record = job.record,
                      .squared_displacement = job.squared_displacement};
  design.state.evaluator = bytes_of(worker.evaluator);
  std::vector<const Mesh*> meshes{&worker.living->mesh()};
  if (hub) meshes.push_back(&hub->mesh());
  const std::optional<std::string> bytes = options.ranks->result_of(
      design.worker, encode(design, meshes), [this] { return evaluating.observer.cancelled(); });
  job.stopped = Stopped::interrupted;
  if (!bytes) return;
  EvaluatedDesign evaluated = decode_evaluated_design(*bytes);
  job.stopped = evaluated.stopped;
  if (job.stopped != Stopped::done) return;
  const std::uint64_t number = job.record.worker;
  job.record = std::move(evaluated.finished.record);
  job.record.worker = number;
  job.evaluation = std::move(evaluated.finished.evaluation);
  worker.token = design.token;
  worker.living = living_around(std::move(evaluated.meshes.front()), evaluated.state.design_of_mesh());
  WorkerState& state = worker.state;
  state.row = evaluated.state.row, state.checked = evaluated.state.checked;
  state.full_adjustments = evaluated.state.full_adjustments;
  worker.evaluator.reset();
  if (std::string& kept = evaluated.state.evaluator; !kept.empty())
    worker.evaluator = std::make_unique<StateElsewhere>(std::move(kept));
}

CrewWork Workers::work_of_crew(const DesignSpace& space, Evaluator& evaluator, const OptimiseOptions& options,
                               std::size_t population) {
  const auto states = std::make_shared<CrewStates<EvaluatorState>>();
  return [&space, &evaluator, &options, population, states, run = identity_of(space, evaluator)](
             const std::string& bytes, const std::function<bool()>& cancelled) -> std::optional<std::string> {
    PostedDesign design = decode_posted_design(bytes);
    if (design.run != run)
      throw Error(ErrorCode::argument, "a rank",
                  "found another problem than rank 0 has, expected the same files on all hosts");
    CrewQuestion question(cancelled);
    Crew crew({space, evaluator, options, population, question});
    if (crew.has_hub()) crew.start_hub(std::move(design.meshes.back()));
    const std::string kept = design.state.evaluator;
    Worker& worker = crew.add(std::move(design.state), std::move(design.meshes.front()));
    worker.evaluator = states->take(design.worker, design.before);
    if (!worker.evaluator && !kept.empty())
      worker.evaluator = restore_state(evaluator, space, kept, worker.living->mesh(), worker.living->design(),
                                       "a design of another process");
    Job job{.proposal = std::move(design.proposal),
            .tasks = std::move(design.tasks),
            .record = std::move(design.record),
            .squared_displacement = design.squared_displacement};
    crew.evaluate(worker, job);
    if (job.stopped == Stopped::interrupted) return std::nullopt;
    EvaluatedDesign evaluated{.stopped = job.stopped,
                              .finished = {std::move(job.record), std::move(job.evaluation)},
                              .state = worker.state,
                              .meshes = {}};
    evaluated.state.mesh_design = worker.living->design();
    evaluated.state.evaluator = bytes_of(worker.evaluator);
    states->put(design.worker, design.token, std::move(worker.evaluator));
    return encode(evaluated, worker.living->mesh());
  };
}

void Workers::Crew::evaluate_next(Worker& worker, Job& job) const {
  if (options.keep_finished)
    worker.before.emplace(Before{worker.living->mesh(), worker.living->design(), worker.state.row,
                                 worker.state.checked, bytes_of(worker.evaluator)});
  options.ranks != nullptr ? evaluate_elsewhere(worker, job) : evaluate(worker, job);
  const bool is_limit = job.stopped != Stopped::done && job.stopped != Stopped::interrupted;
  if (is_limit && worker.before && options.fail_at_limits) fail_at_limit(worker, job);
  job.finished = job.stopped == Stopped::done;
  if (job.finished) worker.before.reset();
}

// The next design goes on from the mesh before this one, of which no flow is known any more.
void Workers::Crew::fail_at_limit(Worker& worker, Job& job) const {
  worker.living->take_back(std::move(worker.before->mesh), std::move(worker.before->design), job.record);
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
    if (!bytes.empty())
      worker.evaluator = restore_state(evaluating.evaluator, evaluating.space, bytes, worker.living->mesh(),
                                       worker.living->design(), source);
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

const std::vector<double>& Workers::design_of_last_mesh() const {
  return crew_->workers[crew_->last].living->design();
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
    state.mesh_design = design_kept(state, worker.living->design());
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
      state.mesh_design = design_kept(state, worker.before->design);
    } else {
      state.row = worker.state.row, state.checked = worker.state.checked;
      state.evaluator = bytes_of(worker.evaluator);
      state.mesh_design = design_kept(state, worker.living->design());
    }
  }
  return result;
}

}  // namespace remodel
