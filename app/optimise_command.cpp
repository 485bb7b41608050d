// remodel optimise --from SHAPE | --mesh MESH --to SHAPE -o DIR: CMA-ES shape interpolation around one living
// mesh.

#include "remodel/optimise.h"

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "evaluate_options.h"
#include "figures.h"
#include "launched.h"
#include "meshing_options.h"
#include "optimise_start.h"
#include "outputs.h"
#include "progress.h"
#include "ranks.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel_options.h"
#include "shape_input.h"

namespace remodel::app {
namespace {

struct OptimiseCommand {
  OptimiseStartOptions start;
  std::string to;  // one of these two
  EvaluateOptions evaluate;
  MeshingOptions meshing;
  OptimiseOptions run;
  RanksOptions ranks;
  int repeat = 1;
  bool quiet = false;
  bool json = false;
};

Json options_json(const OptimiseCommand& command) {
  Json options = meshing_json(command.meshing, command.run);
  options["distance"] = command.run.remodel.distance;
  options["method"] = name_of(command.run.remodel.method);
  options["strategy"] = name_of(command.run.strategy);
  if (command.run.workers != 0) options["workers"] = command.run.workers;
  options["sigma"] = command.run.sigma;
  options["seed"] = command.run.seed;
  options["evaluations"] = command.run.evaluations;
  if (command.run.tolerance != 0.0) options["tolerance"] = command.run.tolerance;
  options["compare_every"] = command.run.compare_every;
  options["checkpoint_every"] = command.run.checkpoint_every;
  return options;
}

void add_result(Report& report, const OptimiseResult& result) {
  const Json object = Json::parse(optimise_result_to_json(result));
  for_each_figure(optimise_figures, result, [&](const auto& figure, const auto&) {
    const Json& value = object[figure.name];
    if (value.is_null() || value == "")
      report.data(figure.name, value);
    else
      report.figure(figure.name, figure.label, value, figure.unit);
  });
  report.data("best", object["best"]);
}

bool all_failed(const OptimiseResult& result) {
  return result.evaluations != 0 && result.failed_evaluations == result.evaluations;
}

Status status_of(const OptimiseResult& result) {
  if (result.stopped != OptimiseStopped::done) return Status::limit;
  return result.invalid_meshes == 0 && !all_failed(result) ? Status::done : Status::answer_is_no;
}

// Runs `repeat` times with the same seed: the same designs and meshes each time, only the times differ, and
// their medians replace those of the last run.
OptimiseResult run_repeatedly(OptimiseCommand& command, const std::function<OptimiseResult()>& run_once) {
  std::vector<double> seconds, remodel_ms, generate_ms;
  OptimiseResult result;
  for (int i = 0; i < command.repeat; ++i) {
    result = run_once();
    command.run.overwrite = true;  // the repetition before
    seconds.push_back(result.seconds);
    remodel_ms.push_back(result.remodel_ms_mean);
    generate_ms.push_back(result.generate_ms_mean);
    if (result.stopped != OptimiseStopped::done) return result;
  }
  result.seconds = median(seconds);
  result.remodel_ms_mean = median(remodel_ms);
  if (command.run.compare_every != 0) {
    result.generate_ms_mean = median(generate_ms);
    result.speedup = result.generate_ms_mean / result.remodel_ms_mean;
  }
  return result;
}

// Reports how many triangles of the mesh that the run started from are left; of a mesh with layers what these
// are like.
void add_last_mesh_figures(Report& report, const OptimiseCommand& command) {
  const std::filesystem::path last = command.run.directory / "last.vtkhdf";
  if (!std::filesystem::exists(last)) return;
  if (command.run.layers)
    add_layer_figures(report, read_layered_mesh(last));
  else if (command.run.start)
    add_part_figures(report, read_mesh(last));
}

void require_one_evaluator(const OptimiseCommand& command) {
  if (command.to.empty() && command.evaluate.command.empty())
    throw Error(ErrorCode::argument, "--to", "not given, --to SHAPE or --evaluate COMMAND expected");
  if (!command.to.empty() && !command.evaluate.command.empty())
    throw Error(ErrorCode::argument, "--evaluate", "given with --to, one of them expected");
  if (!command.to.empty() && command.start.layers.cells == LayerCells::triangles)
    throw Error(ErrorCode::argument, "--layer-cells",
                "given without --evaluate, whose program alone sees the cells of layers");
}

// The program in a process, on a host's own disk space: only one may have a directory of evaluations.
std::unique_ptr<Evaluator> program_of(const OptimiseCommand& command) {
  EvaluateOptions options = command.evaluate;
  options.run.directory = command.run.directory / "evaluations";
  if (launched_rank() > 0) options.run.directory /= "rank-" + std::to_string(launched_rank());
  if (command.run.start) options.run.su2_boxes = command.run.start->su2_boxes;
  options.run.layer_cells = command.start.layers.cells;
  return shell_evaluator(options);
}

// A search of coefficients does not change the trailing edge: the target has the start's.
CstAirfoil target_of(const OptimiseCommand& command, OptimiseStart& start) {
  CstAirfoil to = fit_shape(command.to, command.meshing.fit, start.fits).airfoil;
  to.te_upper = start.from.te_upper, to.te_lower = start.from.te_lower;
  return to;
}

// Under mpirun.
CrewWork work_of_ranks(OptimiseCommand command) {
  if (command.run.workers == 1 || (command.run.workers == 0 && command.run.strategy != MeshStrategy::pool))
    throw Error(ErrorCode::argument, "--workers",
                "found 1 with " + std::to_string(launched_ranks()) +
                    " MPI ranks, expected 2 or more: a living mesh has one design at a time");
  OptimiseStart start = read_start(command.start, command.meshing, command.run);
  if (command.evaluate.command.empty())
    return optimise_work(start.from, target_of(command, start), command.run);
  const std::shared_ptr<Evaluator> evaluator = program_of(command);
  const CrewWork work = optimise_work(start.from, *evaluator, command.run);
  return [evaluator, work](const std::string& bytes, const std::function<bool()>& cancelled) {
    return work(bytes, cancelled);
  };
}

// One run. Command, start and progress must outlive it.
std::function<OptimiseResult()> once(const OptimiseCommand& command, OptimiseStart& start,
                                     Progress& progress) {
  if (!command.evaluate.command.empty()) {
    const std::shared_ptr<Evaluator> evaluator = program_of(command);
    return [&, evaluator] { return optimise(start.from, *evaluator, command.run, &progress); };
  }
  return [&, to = target_of(command, start)] { return optimise(start.from, to, command.run, &progress); };
}

Status run_search(OptimiseCommand& command, PostedJobs* jobs) {
  require_run_directory(command.run.directory);
  if (command.run.resume && command.repeat > 1) {
    throw Error(ErrorCode::argument, "--repeat",
                "found " + std::to_string(command.repeat) + " with --resume, expected 1");
  }
  if (command.run.resume && command.run.overwrite)
    throw Error(ErrorCode::argument, "--overwrite", "found with --resume, expected one of them");
  command.run.keep_finished = !command.evaluate.command.empty();
  command.run.ranks = jobs;
  OptimiseStart start = read_start(command.start, command.meshing, command.run);
  require_used(command.start.given, info_of(command.run.strategy).step,
               command.run.start && command.run.start->mesh.imported(), command.start.mesh);
  const Json options = options_json(command);
  Progress progress(progress_style(command.quiet), command.run.evaluations, "options: " + options.dump());
  if (!command.evaluate.command.empty() && command.run.start)
    progress.say_at_first([&] {
      const FrozenMesh mesh = command.run.start->mesh.freeze();
      warn_of_inner_curves(mesh, "mesh.su2 of the evaluator", "no marker of its is a curve inside the mesh");
      warn_of_names(mesh, "mesh.su2 of the evaluator", MeshFormat::su2, InnerCurves::left_out);
    });
  const OptimiseResult result = run_repeatedly(command, once(command, start, progress));
  progress.finish();

  Report report;
  add_start_figures(report, command.start, start, command.run.layers.has_value());
  if (command.evaluate.command.empty())
    report.figure("to", "to", command.to);
  else
    report.figure("evaluator", "evaluator", command.evaluate.command);
  add_fit_figures(report, start.fits);
  report.data("options", options);
  add_result(report, result);
  add_last_mesh_figures(report, command);
  report.figure("directory", "run directory", command.run.directory.string());
  report.print(command.json);
  if (all_failed(result))
    std::fprintf(stderr, "remodel: all %llu evaluations failed: %s\n",
                 static_cast<unsigned long long>(result.evaluations), result.detail.c_str());
  return status_of(result);
}

Status run(OptimiseCommand& command) {
  require_one_evaluator(command);
  std::vector<std::string> shapes;
  for (const std::string& shape : {command.start.from, command.to})
    if (!shape.empty()) shapes.push_back(shape);
  require_coordinate_file(shapes, command.meshing.fit);
  return with_posted_jobs(
      command.ranks, [&] { return work_of_ranks(command); },
      [&](PostedJobs* jobs) { return run_search(command, jobs); });
}

void add_strategy(CLI::App& app, OptimiseOptions& run) {
  add_strategy_choice(app, name_of(run.strategy), mesh_strategies(),
                      [&run](MeshStrategy strategy) { run.strategy = strategy; });
  add_integer(
      app,
      {"--workers", "W", "1, pool: as many as samples per generation",
       "Living meshes; a design goes to the worker whose last one is nearest. The result depends on it; "
       "1 to 1000"},
      {.low = 1, .high = 1000}, run.workers);
  add_integer(app,
              {"--threads", "T", "as many as cores, at most one per worker",
               "Workers that evaluate at the same time. The result does not depend on it; 1 to 1000"},
              {.low = 1, .high = 1000}, run.threads);
}

void add_search_options(CLI::App& app, OptimiseOptions& run) {
  add_real(app, {"--sigma", "S", "0.05", "Initial standard deviation of the coefficients: above 0, no unit"},
           {.low = 0.0, .high = 1e6, .above_low = true}, run.sigma);
  add_integer(app, {"--seed", "N", "1", "Seed of the samples: the same seed gives the same run; at least 0"},
              {.low = 0}, run.seed);
  const auto add_count = [&](const OptionText& text, std::int64_t low, std::size_t& target) {
    add_integer(app, text, {.low = low, .high = 1'000'000'000}, target);
  };
  add_count({"--evaluations", "N", "9000", "Feasible designs, one remodelling each: at least 1"}, 1,
            run.evaluations);
  add_real(
      app,
      {"--tolerance", "T", "0: never",
       "Ends after the generation in which the objective is at most T, or the search has converged: square "
       "chords, at least 0"},
      {.low = 0.0}, run.tolerance);
  add_count({"--compare-every", "K", "0",
             "Every K-th evaluation also generates a fresh mesh of the design; 0: never"},
            0, run.compare_every);
  add_count({"--checkpoint-every", "K", "500",
             "Evaluations between checkpoints; 0: only at the start, the end and an interrupt"},
            0, run.checkpoint_every);
}

}  // namespace

void require_run_directory(const std::filesystem::path& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(directory, error)) {
    require_writable(directory.has_filename() ? directory : directory.parent_path());
    return;
  }
  if (!fs::is_directory(directory, error)) {
    throw Error(ErrorCode::file, directory.string(), "is a file, expected a directory");
  }
  require_writable(directory / "history.sqlite");
  bool of_a_run = false;
  for (const char* name :
       {"history.sqlite", "checkpoint.json", "first.vtkhdf", ".remodel-start", "stage-1"}) {
    of_a_run = of_a_run || fs::exists(directory / name);
  }
  if (!of_a_run && !fs::is_empty(directory)) {
    throw Error(ErrorCode::file, directory.string(),
                "is a directory with other files, expected a new, an empty or a run directory");
  }
}

void add_optimise_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<OptimiseCommand>();
  CLI::App& app =
      add_command(program, "optimise",
                  "Changes one airfoil into another by CMA-ES, remodelling one living mesh", command, action);
  add_optimise_start_options(app, command->start);
  add_text(app, {"--to", "SHAPE", "", "Airfoil whose points the design is to interpolate; or --evaluate"},
           Presence::optional, command->to);
  add_evaluate_option(
      app,
      "Shell command that is run for each design: {mesh}, {design}, {state}, {result} and {directory} in it "
      "are files of its own, the state what it left of the design before, carried over to the new mesh "
      "(docs/solvers.md); without any of them it is run as `COMMAND MESH.su2 DESIGN.json`. Its result is a "
      "JSON object: objective, and optionally constraints[] (at most 0), gradient[] and outputs{}",
      command->evaluate);
  add_evaluation_options(app, command->evaluate);
  add_text(
      app,
      {"-o,--output", "DIR", "", "Run directory: new or empty; that of a run with --resume or --overwrite"},
      Presence::required, command->run.directory);
  add_meshing_options(app, command->meshing);
  add_remodel_options(app, command->run.remodel);
  add_strategy(app, command->run);
  add_rank_option(app, command->ranks);
  add_search_options(app, command->run);
  add_flag(app, "--resume", "Continue from the checkpoint in the run directory", command->run.resume);
  add_flag(app, "--overwrite", "Replace the run that the run directory holds", command->run.overwrite);
  add_repeat(app, command->repeat);
  add_flag(app, "--quiet", "No progress and no options on standard error", command->quiet);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
