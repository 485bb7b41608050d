#include "optimise/workers.h"

#include <algorithm>
#include <limits>
#include <thread>
#include <utility>

#include "optimise/stopwatch.h"

namespace remodel {
namespace {

struct Worker {
  std::unique_ptr<MeshChain> chain;
  WorkerState state;
  DesignProfile profile;     // of its last design
  std::vector<Job*> jobs{};  // handed to it, in order
};

Parameters stations_of(const OptimiseOptions& options) {
  if (options.start) return options.start->place.parameters;
  return Parameters::uniform(static_cast<std::size_t>(options.domain.points));
}

std::size_t thread_count(const OptimiseOptions& options, std::size_t workers) {
  const std::size_t wanted =
      options.threads != 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  return std::min(wanted, workers);
}

}  // namespace

std::size_t worker_count(const OptimiseOptions& options, std::size_t population) {
  return options.workers != 0 ? options.workers : population;
}

std::size_t mesh_count(const OptimiseOptions& options, std::size_t population) {
  return worker_count(options, population) + (options.use == MeshUse::hub ? 1 : 0);
}

struct Workers::Crew {
  Crew(const OptimiseOptions& given, std::size_t population, const CstAirfoil& family)
      : options(given),
        like(family),
        profile_of(stations_of(given), family),
        at_work(std::min(worker_count(given, population), population)),
        share((population + at_work - 1) / at_work),
        team(thread_count(given, worker_count(given, population))) {}

  void add(WorkerState state, Mesh mesh);
  Worker& nearest(const DesignProfile& design);
  void hand_out(std::vector<Job>& jobs);
  void evaluate(Worker& worker, Job& job) const;

  const OptimiseOptions& options;
  CstAirfoil like;
  ProfileMaker profile_of;
  std::size_t at_work;  // at most, in a generation
  std::size_t share;    // the most designs of a generation that one worker takes
  ThreadTeam team;
  std::optional<Hub> hub;
  std::vector<Worker> workers;
  std::size_t last = 0;
  // What the hub did since the last evaluation: the next one answers for it.
  double hub_seconds = 0.0;
  bool hub_refreshed = false;
};

void Workers::Crew::add(WorkerState state, Mesh mesh) {
  const CstAirfoil design = with_coefficients(like, state.coefficients);
  auto chain = hub ? std::make_unique<HubChain>(options, *hub, std::move(mesh))
                   : std::make_unique<MeshChain>(options, std::move(mesh), at_work);
  workers.push_back({.chain = std::move(chain), .state = std::move(state), .profile = profile_of(design)});
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
  const bool regenerates = options.use == MeshUse::regenerate;
  for (Job& job : jobs) {
    Worker* worker = &workers.front();
    if (workers.size() > 1 || regenerates) {
      DesignProfile profile = profile_of(job.design);
      worker = &nearest(profile);
      job.squared_displacement = squared_displacement(worker->profile, profile);
      worker->profile = std::move(profile);
    }
    worker->state.coefficients = coefficients_of(job.design);
    ++worker->state.evaluated;
    worker->jobs.push_back(&job);
    last = static_cast<std::size_t>(worker - workers.data());
    job.record.worker = last + 1;
  }
}

void Workers::Crew::evaluate(Worker& worker, Job& job) const {
  WorkerState& state = worker.state;
  if (options.use == MeshUse::regenerate)
    job.tasks.generate = RegenerationRule::generate(job.squared_displacement, state.row);
  if (!std::exchange(state.checked, true)) job.tasks.check = std::max(job.tasks.check, Checked::quick);
  job.stopped = worker.chain->step(job.design, job.tasks, job.record);
  state.full_adjustments += job.record.full_adjustment ? 1 : 0;
  if (options.use == MeshUse::regenerate)
    state.row = RegenerationRule::after(state.row, job.record.full_adjustment, job.tasks.generate);
}

Workers::Workers(const OptimiseOptions& options, std::size_t population, const CstAirfoil& from,
                 const Mesh& mesh)
    : crew_(std::make_unique<Crew>(options, population, from)) {
  if (options.use == MeshUse::hub) crew_->hub.emplace(options, population, mesh);
  for (std::size_t i = 0; i < worker_count(options, population); ++i)
    crew_->add({.coefficients = coefficients_of(from)}, mesh);
}

Workers::Workers(const OptimiseOptions& options, std::size_t population, const CstAirfoil& like,
                 const WorkersState& state, std::vector<Mesh> meshes)
    : crew_(std::make_unique<Crew>(options, population, like)) {
  if (options.use == MeshUse::hub) crew_->hub.emplace(options, population, std::move(meshes.back()));
  for (std::size_t i = 0; i < state.workers.size(); ++i) crew_->add(state.workers[i], std::move(meshes[i]));
  crew_->last = state.last;
}

Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;

std::size_t Workers::count() const {
  return crew_->workers.size();
}

void Workers::begin_generation(const std::optional<CstAirfoil>& mean) {
  Hub::Generation before;
  for (Worker& worker : crew_->workers) {
    before.evaluated += std::exchange(worker.state.evaluated, 0);
    before.full_adjustments += std::exchange(worker.state.full_adjustments, 0);
  }
  if (!crew_->hub || !mean) return;
  const ThreadStopwatch watch;
  crew_->hub_refreshed |= crew_->hub->follow(*mean, before);
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
      crew_->evaluate(*busy[i], *job);
      if (job->stopped != Stopped::done) return;
    }
  });
  jobs.front().record.remodel_seconds += std::exchange(crew_->hub_seconds, 0.0);
  jobs.front().record.refreshed |= std::exchange(crew_->hub_refreshed, false);
}

const Mesh& Workers::last_mesh() const {
  return crew_->workers[crew_->last].chain->mesh();
}

std::vector<const Mesh*> Workers::meshes() const {
  std::vector<const Mesh*> result;
  for (const Worker& worker : crew_->workers) result.push_back(&worker.chain->mesh());
  if (crew_->hub) result.push_back(&crew_->hub->mesh());
  return result;
}

WorkersState Workers::state() const {
  WorkersState result{.workers = {}, .last = crew_->last};
  for (const Worker& worker : crew_->workers) result.workers.push_back(worker.state);
  return result;
}

}  // namespace remodel
