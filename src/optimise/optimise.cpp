#include "remodel/optimise.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "optimise/checkpoint.h"
#include "optimise/checksum.h"
#include "optimise/design_domains.h"
#include "optimise/run_directory.h"
#include "optimise/shape_search.h"
#include "optimise/summary.h"
#include "optimise/workers.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/strategy.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_workers = 1000;

void require_good(const OptimiseOptions& options) {
  const auto require = [](bool good, const char* option, const char* expected) {
    if (!good) throw Error(ErrorCode::argument, option, expected);
  };
  require(options.evaluations >= 1, "evaluations", "expected at least 1");
  require(options.max_refused >= 1, "max_refused", "expected at least 1");
  require(options.sigma > 0.0 && std::isfinite(options.sigma), "sigma", "expected more than 0");
  require(options.workers <= most_workers, "workers", "expected 0 to 1000");
  require(options.threads <= most_workers, "threads", "expected 0 to 1000");
  require(options.use != MeshUse::regenerate || !options.start, "use",
          "expected chain or hub with a start mesh: regenerate would replace it");
  require(!options.directory.empty(), "directory", "expected the run's directory");
}

// Everything that the designs, rows and meshes of a run depend on, but for the number of evaluations.
std::string settings_of(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options,
                        std::size_t workers) {
  const QualityOptions& quality = quality_of(options);
  nlohmann::ordered_json json = {
      {"version", REMODEL_VERSION},
      {"from", nlohmann::ordered_json::parse(airfoil_to_json(from))},
      {"to", nlohmann::ordered_json::parse(airfoil_to_json(to))},
      {"points", options.domain.points},
      {"farfield_radius", options.domain.farfield_radius},
      {"farfield_points", options.domain.farfield_points},
      {"min_angle_deg", quality.min_angle_deg},
      {"max_gradation", quality.max_gradation},
      {"gradation", quality.gradation},
      {"resolution", quality.resolution},
      {"max_vertices", quality.max_vertices},
      {"min_edge", quality.min_edge},
      {"distance", options.remodel.distance},
      {"method", name_of(options.remodel.method)},
      {"strategy", name_of(options.remodel.strategy)},
      {"mesh_use", name_of(options.use)},
      {"workers", workers},
      {"keep", resolved_keep(options.remodel, quality)},
      {"sigma", options.sigma},
      {"seed", options.seed},
      {"compare_every", options.compare_every},
      {"full_check_every", options.full_check_every},
  };
  if (options.start) {
    json["refine_angle_deg"] = quality.refine_angle_deg;
    json["start_mesh"] = identity_of(*options.start);
  }
  return json.dump();
}

// Which of two settings differ, for the error message.
std::string differences(const std::string& a, const std::string& b) {
  const auto first = nlohmann::json::parse(a, nullptr, false), second = nlohmann::json::parse(b);
  if (!first.is_object()) return "all";
  std::string names;
  for (const auto& [key, value] : second.items()) {
    if (!first.contains(key) || first[key] != value) names += (names.empty() ? "" : ", ") + key;
  }
  return names;
}

// Whether something that is due every k evaluations, 0 for never, is due.
bool every(std::size_t k, std::uint64_t evaluation) {
  return k != 0 && evaluation % k == 0;
}

void add(Checksum& sum, const std::map<std::string, std::string>& run) {
  for (const auto& [key, value] : run) {
    sum.add(key + '=');
    sum.add(value + '\n');
  }
}

void add(Checksum& sum, const EvaluationRecord& record) {
  sum.add(record.evaluation);
  sum.add(record.generation);
  for (const double coefficient : record.coefficients) sum.add(coefficient);
  for (const double value :
       {record.objective, record.best_objective, record.sigma, record.preserved_percent, record.min_angle_deg,
        record.remodel_seconds, record.generate_seconds.value_or(-1.0), record.gradation_bias.value_or(0.0),
        record.gradation_deviation.value_or(-1.0), record.generated_gradation_bias.value_or(0.0),
        record.generated_gradation_deviation.value_or(-1.0)})
    sum.add(value);
  for (const std::size_t count : {record.triangles_before, record.triangles, record.preserved, record.moved,
                                  record.inserted, record.removed, record.generated_triangles.value_or(0)})
    sum.add(std::uint64_t{count});
  sum.add(record.infeasible_samples);
  sum.add(record.worker);
  sum.add(std::string(name_of(record.checked)));
  for (const bool flag : {record.full_adjustment, record.refreshed, record.regenerated, record.valid})
    sum.add(flag ? "1" : "0");
  sum.add(record.detail);
}

// All that changes as a run goes on.
struct Progress {
  RunDirectory directory;
  ShapeSearch search;
  Workers workers;
  History history;
  Summary summary;
  Checksum written;           // of the history
  std::uint64_t refused = 0;  // infeasible samples since the last evaluation
  double earlier_seconds = 0.0;
};

class Run {
 public:
  Run(Progress progress, const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options)
      : progress_(std::move(progress)),
        from_(from),
        target_(to),
        options_(options),
        population_(static_cast<std::size_t>(progress_.search.cmaes().population())),
        settings_(settings_of(from, to, options, progress_.workers.count())) {}

  void checkpoint();
  OptimiseStopped evaluate_all(OptimiseObserver& observer);
  OptimiseResult finish(OptimiseStopped stopped);

 private:
  OptimiseStopped evaluate_some(OptimiseObserver& observer);
  void begin_generation();
  std::size_t at_once() const;
  Job job_of(const Sample& sample, std::uint64_t evaluation) const;
  void complete(const Sample& sample, EvaluationRecord& record);
  StepTasks tasks(std::uint64_t evaluation) const;
  std::uint64_t evaluations() const { return progress_.summary.evaluations(); }
  std::uint64_t middle() const { return (options_.evaluations + 1) / 2; }
  double seconds() const {
    return progress_.earlier_seconds + std::chrono::duration<double>(Clock::now() - began_).count();
  }

  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  Progress progress_;
  CstAirfoil from_;
  InterpolationObjective target_;
  const OptimiseOptions& options_;
  std::size_t population_;
  std::string settings_;
};

OptimiseStopped Run::evaluate_all(OptimiseObserver& observer) {
  while (evaluations() < options_.evaluations) {
    if (observer.cancelled()) return OptimiseStopped::interrupted;
    if (const OptimiseStopped stopped = evaluate_some(observer); stopped != OptimiseStopped::done)
      return stopped;
  }
  return OptimiseStopped::done;
}

// The distribution changes between generations only: what is evaluated at once is of one generation, and ends
// where a mesh or a checkpoint is written. One worker has nothing to do at once.
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
  if (evaluations() % population_ == 0) begin_generation();
  std::vector<Sample> samples;
  std::vector<Job> jobs;
  const std::size_t wanted = at_once();
  while (jobs.size() < wanted) {
    std::optional<Sample> sample = progress_.search.next(options_.max_refused);
    if (!sample) break;
    jobs.push_back(job_of(*sample, evaluations() + jobs.size() + 1));
    samples.push_back(std::move(*sample));
  }
  progress_.workers.evaluate(jobs);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i].stopped != Stopped::done) return OptimiseStopped::mesh_limit;
    complete(samples[i], jobs[i].record);
    observer.evaluated(jobs[i].record);
  }
  if (jobs.size() < wanted) {
    progress_.refused += options_.max_refused;
    return OptimiseStopped::infeasible;
  }
  if (evaluations() == middle())
    write_mesh(progress_.workers.last_mesh(), options_.directory / "middle.vtkhdf");
  if (every(options_.checkpoint_every, evaluations())) checkpoint();
  return OptimiseStopped::done;
}

void Run::begin_generation() {
  const bool hub = options_.use == MeshUse::hub;
  progress_.workers.begin_generation(hub ? progress_.search.mean_design() : std::nullopt);
}

Job Run::job_of(const Sample& sample, std::uint64_t evaluation) const {
  Job job{.design = sample.design, .tasks = tasks(evaluation), .record = {}};
  job.record.evaluation = evaluation;
  job.record.generation = progress_.search.cmaes().generation();
  job.record.coefficients = sample.coefficients;
  job.record.objective = target_.mean_square(sample.design);
  job.record.sigma = progress_.search.cmaes().sigma();
  return job;
}

// Completes the row of an evaluation and tells everybody.
void Run::complete(const Sample& sample, EvaluationRecord& record) {
  record.best_objective = std::min(progress_.summary.best_objective(), record.objective);
  record.infeasible_samples = progress_.refused + sample.refused;
  progress_.refused = 0;
  progress_.search.tell(sample, record.objective);
  progress_.history.append(record);
  progress_.summary.add(record);
  add(progress_.written, record);
}

// What a step changed is checked always, the whole mesh now and then, and at each worker's first step: so
// every triangle that ever was is checked once, and the smallest of all angles is known.
StepTasks Run::tasks(std::uint64_t evaluation) const {
  constexpr std::size_t quick_check_every = 20;
  const std::size_t full_check_every =
      options_.full_check_every != 0 ? options_.full_check_every : options_.compare_every;
  return {.compare = every(options_.compare_every, evaluation),
          .check = every(full_check_every, evaluation)    ? Checked::full
                   : every(quick_check_every, evaluation) ? Checked::quick
                                                          : Checked::changes};
}

// The history first: a checkpoint never stands for rows that are not on disk.
void Run::checkpoint() {
  progress_.history.commit();
  write_checkpoint(options_.directory,
                   {.settings = settings_,
                    .evaluation = evaluations(),
                    .refused = progress_.refused,
                    .finished = evaluations() >= options_.evaluations,
                    .seconds = seconds(),
                    .cmaes = progress_.search.cmaes().state(),
                    .workers = progress_.workers.state(),
                    .history_checksum = progress_.written.text()},
                   progress_.workers.meshes());
}

OptimiseResult Run::finish(OptimiseStopped stopped) {
  progress_.history.commit();
  // At a mesh limit the mesh is not that of the last row: the checkpoint before is what can be gone on from.
  if (stopped != OptimiseStopped::mesh_limit) {
    write_mesh(progress_.workers.last_mesh(), options_.directory / "last.vtkhdf");
    checkpoint();
  }
  OptimiseResult result = progress_.summary.result();
  result.infeasible_samples += progress_.refused;
  result.stopped = stopped;
  result.seed = options_.seed;
  result.workers = progress_.workers.count();
  result.best = from_;
  if (result.evaluations > 0) {
    result.best = with_coefficients(from_, progress_.summary.best_coefficients());
    result.max_error = target_.max_error(result.best);
  }
  result.seconds = seconds();
  write_text_atomically(options_.directory / "best.json", airfoil_to_json(result.best));
  write_text_atomically(options_.directory / "result.json", optimise_result_to_json(result) + "\n");
  return result;
}

void refuse_unfinished_run(const fs::path& directory) {
  if (has_checkpoint(directory) && !read_checkpoint(directory).finished)
    throw Error(ErrorCode::argument, directory.string(),
                "holds an unfinished run: expected resume, or another directory");
}

// Samples a generation: the dimension decides.
std::size_t population_of(const CstAirfoil& from, const OptimiseOptions& options) {
  return static_cast<std::size_t>(initial_distribution(from, options.sigma, options.seed).population());
}

ShapeSearch search_of(const CstAirfoil& from, const OptimiseOptions& options, Cmaes cmaes) {
  if (!options.start) return ShapeSearch(from, options.domain, std::move(cmaes));
  return ShapeSearch(from, std::move(cmaes), [domains = DesignDomains(options)](const CstAirfoil& design) {
    return domains.feasible(design);
  });
}

// The start of a run, complete on the disk before it replaces what the directory holds.
Progress begin(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options,
               RunDirectory directory, const Mesh& mesh) {
  Cmaes cmaes = initial_distribution(from, options.sigma, options.seed);
  const std::size_t population = population_of(from, options);
  Workers workers(options, population, from, mesh);
  const std::map<std::string, std::string> run = {
      {"version", REMODEL_VERSION},
      {"options", settings_of(from, to, options, workers.count())},
      {"seed", std::to_string(options.seed)},
      {"from", airfoil_to_json(from)},
      {"to", airfoil_to_json(to)}};
  Checksum written;
  add(written, run);
  try {
    const fs::path start = directory.make_start();
    write_mesh(mesh, start / "first.vtkhdf");
    History::create(start / "history.sqlite", run);
    const std::vector<const Mesh*> everywhere(mesh_count(options, population), &mesh);
    write_checkpoint(start,
                     {.settings = run.at("options"),
                      .cmaes = cmaes.state(),
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
          .search = search_of(from, options, std::move(cmaes)),
          .workers = std::move(workers),
          .history = std::move(history),
          .summary = {},
          .written = written};
}

void require_settings(const std::string& found, const std::string& expected, const fs::path& directory) {
  if (found != expected)
    throw Error(
        ErrorCode::argument, directory.string(),
        "expected the options of the run to be resumed, found others: " + differences(found, expected));
}

// The first rows of the history as the checkpoint knows them. Whatever a damaged file may hold, it is refused
// before it is written to.
Summary replay(const fs::path& file, const Checkpoint& checkpoint, std::size_t dimension, Checksum& written) {
  const History history = History::open(file);
  const std::map<std::string, std::string> run = history.run();
  const auto stored = run.find("options");
  require_settings(stored == run.end() ? "" : stored->second, checkpoint.settings, file.parent_path());
  add(written, run);
  Summary summary;
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

Workers restored_workers(const OptimiseOptions& options, std::size_t population, const CstAirfoil& from,
                         const Checkpoint& checkpoint) {
  std::vector<Mesh> meshes = read_checkpoint_meshes(options.directory);
  const std::size_t workers = worker_count(options, population), dimension = coefficients_of(from).size();
  const auto fits = [&](const WorkerState& worker) { return worker.coefficients.size() == dimension; };
  const std::vector<WorkerState>& states = checkpoint.workers.workers;
  if (states.size() != workers || meshes.size() != mesh_count(options, population) ||
      !std::all_of(states.begin(), states.end(), fits))
    throw Error(ErrorCode::format, (options.directory / "checkpoint.json").string(),
                "expected " + std::to_string(workers) + " workers with a mesh and " +
                    std::to_string(dimension) + " coefficients each");
  return Workers(options, population, from, checkpoint.workers, std::move(meshes));
}

Progress go_on(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options) {
  if (!has_checkpoint(options.directory)) read_checkpoint(options.directory);  // says that it is missing
  RunDirectory directory(options.directory);
  const fs::path checkpoint_file = options.directory / "checkpoint.json";
  const fs::path history_file = options.directory / "history.sqlite";
  const Checkpoint checkpoint = read_checkpoint(options.directory);
  const std::size_t population = population_of(from, options);
  require_settings(checkpoint.settings, settings_of(from, to, options, worker_count(options, population)),
                   options.directory);
  Cmaes cmaes = Cmaes::restore(checkpoint.cmaes, checkpoint_file.string());
  const std::size_t dimension = coefficients_of(from).size();
  if (cmaes.mean().size() != dimension)
    throw Error(ErrorCode::format, checkpoint_file.string(),
                "expected " + std::to_string(dimension) + " coefficients, found " +
                    std::to_string(cmaes.mean().size()));
  Workers workers = restored_workers(options, population, from, checkpoint);
  Checksum written;
  Summary summary = replay(history_file, checkpoint, dimension, written);
  return {.directory = std::move(directory),
          .search = search_of(from, options, std::move(cmaes)),
          .workers = std::move(workers),
          .history = History::resume(history_file, checkpoint.evaluation),
          .summary = std::move(summary),
          .written = written,
          .refused = checkpoint.refused,
          .earlier_seconds = checkpoint.seconds};
}

OptimiseResult unmeshable_start(const CstAirfoil& from, const OptimiseOptions& options) {
  OptimiseResult result;
  result.stopped = OptimiseStopped::mesh_limit;
  result.seed = options.seed;
  result.workers = worker_count(options, population_of(from, options));
  result.best = from;
  return result;
}

}  // namespace

OptimiseResult optimise(const CstAirfoil& start, const CstAirfoil& target, const OptimiseOptions& options,
                        OptimiseObserver* observer) {
  require_good(options);
  require_same_family(start, target);
  const int degree = std::max(start.degree(), target.degree());
  const CstAirfoil from = raise_degree(start, degree), to = raise_degree(target, degree);

  OptimiseObserver silent;
  OptimiseObserver& listener = observer ? *observer : silent;
  if (options.resume) {
    Run run(go_on(from, to, options), from, to, options);
    return run.finish(run.evaluate_all(listener));
  }
  // What is there is locked before it is looked at; a directory is made only for a run that can start.
  std::optional<RunDirectory> directory;
  if (fs::exists(options.directory)) {
    directory.emplace(options.directory);
    refuse_unfinished_run(options.directory);
  }
  std::optional<Mesh> first = first_mesh(from, options);
  if (!first) return unmeshable_start(from, options);
  if (!directory) directory.emplace(options.directory);
  refuse_unfinished_run(options.directory);
  Run run(begin(from, to, options, std::move(*directory), *first), from, to, options);
  return run.finish(run.evaluate_all(listener));
}

}  // namespace remodel
