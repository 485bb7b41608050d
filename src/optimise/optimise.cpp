#include "remodel/optimise.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "optimise/checkpoint.h"
#include "optimise/mesh_chain.h"
#include "optimise/shape_search.h"
#include "optimise/summary.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

void require_same_family(const CstAirfoil& from, const CstAirfoil& to) {
  if (from.e1 != to.e1 || from.e2 != to.e2 || from.te_upper != to.te_upper || from.te_lower != to.te_lower)
    throw Error(ErrorCode::argument, "start and target airfoils",
                "expected the same class exponents and trailing edges: only shape coefficients are searched");
  for (const auto& [airfoil, name] : {std::pair{&from, "start airfoil"}, std::pair{&to, "target airfoil"}}) {
    if (!surfaces_apart(*airfoil)) throw Error(ErrorCode::geometry, name, "its surfaces touch or cross");
  }
}

void require_good(const OptimiseOptions& options) {
  const auto require = [](bool good, const char* option, const char* expected) {
    if (!good) throw Error(ErrorCode::argument, option, expected);
  };
  require(options.evaluations >= 1, "evaluations", "expected at least 1");
  require(options.max_refused >= 1, "max_refused", "expected at least 1");
  require(options.sigma > 0.0 && std::isfinite(options.sigma), "sigma", "expected more than 0");
  require(!options.directory.empty(), "directory", "expected the run's directory");
}

// Everything that the designs, rows and meshes of a run depend on, but for the number of evaluations.
std::string settings_of(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options) {
  const nlohmann::ordered_json json = {
      {"version", REMODEL_VERSION},
      {"from", nlohmann::ordered_json::parse(airfoil_to_json(from))},
      {"to", nlohmann::ordered_json::parse(airfoil_to_json(to))},
      {"points", options.domain.points},
      {"farfield_radius", options.domain.farfield_radius},
      {"farfield_points", options.domain.farfield_points},
      {"min_angle_deg", options.quality.min_angle_deg},
      {"max_gradation", options.quality.max_gradation},
      {"gradation", options.quality.gradation},
      {"resolution", options.quality.resolution},
      {"max_vertices", options.quality.max_vertices},
      {"min_edge", options.quality.min_edge},
      {"distance", options.remodel.distance},
      {"method", name_of(options.remodel.method)},
      {"sigma", options.sigma},
      {"seed", options.seed},
      {"compare_every", options.compare_every},
      {"full_check_every", options.full_check_every},
  };
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

// All that changes as a run goes on.
struct Progress {
  ShapeSearch search;
  MeshChain chain;
  History history;
  Summary summary;
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
        settings_(settings_of(from, to, options)) {}

  void checkpoint();
  OptimiseStopped evaluate_all(OptimiseObserver& observer);
  OptimiseResult finish(OptimiseStopped stopped);

 private:
  OptimiseStopped evaluate(OptimiseObserver& observer);
  EvaluationRecord record_of(const Sample& sample) const;
  StepTasks tasks(std::uint64_t evaluation) const;
  void write_best_and_result(const OptimiseResult& result) const;
  double seconds() const {
    return progress_.earlier_seconds + std::chrono::duration<double>(Clock::now() - began_).count();
  }

  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  Progress progress_;
  CstAirfoil from_;
  InterpolationObjective target_;
  const OptimiseOptions& options_;
  std::string settings_;
};

OptimiseStopped Run::evaluate_all(OptimiseObserver& observer) {
  while (progress_.summary.evaluations() < options_.evaluations) {
    if (observer.cancelled()) return OptimiseStopped::interrupted;
    if (const OptimiseStopped stopped = evaluate(observer); stopped != OptimiseStopped::done) return stopped;
  }
  return OptimiseStopped::done;
}

OptimiseStopped Run::evaluate(OptimiseObserver& observer) {
  const std::optional<Sample> sample = progress_.search.next(options_.max_refused);
  if (!sample) {
    progress_.refused += options_.max_refused;
    return OptimiseStopped::infeasible;
  }
  EvaluationRecord record = record_of(*sample);
  const Stopped mesh = progress_.chain.step(sample->design, tasks(record.evaluation), record);
  if (mesh != Stopped::done) return OptimiseStopped::mesh_limit;

  progress_.search.tell(*sample, record.objective);
  progress_.history.append(record);
  progress_.summary.add(record);
  progress_.refused = 0;
  observer.evaluated(record);
  if (record.evaluation == (options_.evaluations + 1) / 2)
    write_mesh(progress_.chain.mesh(), options_.directory / "middle.vtkhdf");
  if (every(options_.checkpoint_every, record.evaluation)) checkpoint();
  return OptimiseStopped::done;
}

EvaluationRecord Run::record_of(const Sample& sample) const {
  EvaluationRecord record;
  record.evaluation = progress_.summary.evaluations() + 1;
  record.generation = progress_.search.cmaes().generation();
  record.coefficients = sample.coefficients;
  record.objective = target_.mean_square(sample.design);
  record.best_objective = std::min(progress_.summary.best_objective(), record.objective);
  record.sigma = progress_.search.cmaes().sigma();
  record.infeasible_samples = progress_.refused + sample.refused;
  return record;
}

StepTasks Run::tasks(std::uint64_t evaluation) const {
  const std::size_t check_every =
      options_.full_check_every != 0 ? options_.full_check_every : options_.compare_every;
  return {.compare = every(options_.compare_every, evaluation), .full_check = every(check_every, evaluation)};
}

// The history first: a checkpoint never stands for rows that are not on disk.
void Run::checkpoint() {
  progress_.history.commit();
  const std::uint64_t evaluations = progress_.summary.evaluations();
  write_checkpoint(options_.directory,
                   {.settings = settings_,
                    .evaluation = evaluations,
                    .refused = progress_.refused,
                    .finished = evaluations >= options_.evaluations,
                    .seconds = seconds(),
                    .cmaes = progress_.search.cmaes().state()},
                   progress_.chain.mesh());
}

OptimiseResult Run::finish(OptimiseStopped stopped) {
  progress_.history.commit();
  // At a mesh limit the mesh is not that of the last row: the checkpoint before is what can be gone on from.
  if (stopped != OptimiseStopped::mesh_limit) {
    write_mesh(progress_.chain.mesh(), options_.directory / "last.vtkhdf");
    checkpoint();
  }
  OptimiseResult result = progress_.summary.result();
  result.infeasible_samples += progress_.refused;
  result.stopped = stopped;
  result.seed = options_.seed;
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

void make_directory(const fs::path& directory) {
  std::error_code problem;
  fs::create_directories(directory, problem);
  if (problem)
    throw Error(ErrorCode::file, directory.string(), "cannot make the directory: " + problem.message());
}

void refuse_unfinished_run(const fs::path& directory) {
  if (has_checkpoint(directory) && !read_checkpoint(directory).finished)
    throw Error(ErrorCode::argument, directory.string(),
                "holds an unfinished run: expected resume, or another directory");
}

Progress begin(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options, Mesh mesh) {
  const fs::path& directory = options.directory;
  make_directory(directory);
  remove_checkpoint(directory);  // of a finished run, before its history is replaced
  for (const char* name : {"result.json", "best.json", "middle.vtkhdf", "last.vtkhdf"})
    fs::remove(directory / name);
  write_mesh(mesh, directory / "first.vtkhdf");
  History history =
      History::create(directory / "history.sqlite", {{"version", REMODEL_VERSION},
                                                     {"options", settings_of(from, to, options)},
                                                     {"seed", std::to_string(options.seed)},
                                                     {"from", airfoil_to_json(from)},
                                                     {"to", airfoil_to_json(to)}});
  Cmaes cmaes = initial_distribution(from, options.sigma, options.seed);
  return {.search = ShapeSearch(from, options.domain, std::move(cmaes)),
          .chain = MeshChain(options, std::move(mesh)),
          .history = std::move(history),
          .summary = {}};
}

Progress go_on(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options) {
  const fs::path& directory = options.directory;
  const std::string settings = settings_of(from, to, options);
  const Checkpoint checkpoint = read_checkpoint(directory);
  const fs::path file = directory / "history.sqlite";
  for (const std::string& stored : {checkpoint.settings, History::open(file).run()["options"]}) {
    if (stored != settings)
      throw Error(
          ErrorCode::argument, directory.string(),
          "expected the options of the run to be resumed, found others: " + differences(stored, settings));
  }
  const std::size_t dimension = coefficients_of(from).size();
  const auto require_dimension = [&](std::size_t found, const fs::path& source) {
    if (found != dimension)
      throw Error(ErrorCode::format, source.string(),
                  "expected " + std::to_string(dimension) + " coefficients, found " + std::to_string(found));
  };
  Cmaes cmaes = Cmaes::restore(checkpoint.cmaes, (directory / "checkpoint.json").string());
  require_dimension(cmaes.mean().size(), directory / "checkpoint.json");
  Progress progress{.search = ShapeSearch(from, options.domain, std::move(cmaes)),
                    .chain = MeshChain(options, read_checkpoint_mesh(directory)),
                    .history = History::resume(file, checkpoint.evaluation),
                    .summary = {},
                    .refused = checkpoint.refused,
                    .earlier_seconds = checkpoint.seconds};
  progress.history.each([&](const EvaluationRecord& record) {
    require_dimension(record.coefficients.size(), file);
    progress.summary.add(record);
  });
  return progress;
}

OptimiseResult unmeshable_start(const CstAirfoil& from, const OptimiseOptions& options) {
  OptimiseResult result;
  result.stopped = OptimiseStopped::mesh_limit;
  result.seed = options.seed;
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
  refuse_unfinished_run(options.directory);
  GenerateResult first = generate(airfoil_domain(from, options.domain), options.quality);
  if (first.stopped != Stopped::done) return unmeshable_start(from, options);
  Run run(begin(from, to, options, std::move(first.mesh)), from, to, options);
  run.checkpoint();
  return run.finish(run.evaluate_all(listener));
}

}  // namespace remodel
