// remodel optimise --from SHAPE | --mesh MESH --to SHAPE -o DIR: CMA-ES shape interpolation around one living
// mesh.

#include "remodel/optimise.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "meshing_options.h"
#include "optimise_start.h"
#include "outputs.h"
#include "progress.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel_options.h"

namespace remodel::app {
namespace {

// What --strategy chooses: how a step is made, and which mesh it starts from.
struct RunStrategy {
  const char* name;
  Strategy step;
  MeshUse use;
};
constexpr std::array<RunStrategy, 5> run_strategies{{
    {"chain", Strategy::chain, MeshUse::chain},
    {"renew", Strategy::renew, MeshUse::chain},
    {"hub", Strategy::renew, MeshUse::hub},
    {"pool", Strategy::renew, MeshUse::chain},
    {"regenerate", Strategy::chain, MeshUse::regenerate},
}};

struct OptimiseCommand {
  OptimiseStartOptions start;
  std::string to;
  MeshingOptions meshing;
  OptimiseOptions run;
  std::string strategy = "renew";
  std::optional<std::size_t> workers;
  int repeat = 1;
  bool quiet = false;
  bool json = false;
};

// Nothing that is not a run's own may be mixed with its files or replaced by them.
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
  for (const char* name : {"history.sqlite", "checkpoint.json", "first.vtkhdf", ".remodel-start"}) {
    of_a_run = of_a_run || fs::exists(directory / name);
  }
  if (!of_a_run && !fs::is_empty(directory)) {
    throw Error(ErrorCode::file, directory.string(),
                "is a directory with other files, expected a new, an empty or a run directory");
  }
}

Json options_json(const OptimiseCommand& command) {
  Json options = meshing_json(command.meshing, command.run);
  options["distance"] = command.run.remodel.distance;
  options["method"] = name_of(command.run.remodel.method);
  options["strategy"] = command.strategy;
  if (command.run.workers != 0) options["workers"] = command.run.workers;
  options["sigma"] = command.run.sigma;
  options["seed"] = command.run.seed;
  options["evaluations"] = command.run.evaluations;
  options["compare_every"] = command.run.compare_every;
  options["checkpoint_every"] = command.run.checkpoint_every;
  return options;
}

struct Figure {
  const char* key;
  const char* label;
  const char* unit;
};
constexpr std::array<Figure, 27> figures{{
    {"evaluations", "evaluations", ""},
    {"infeasible_samples", "infeasible samples, drawn again", ""},
    {"full_adjustments", "full adjustments", ""},
    {"objective", "best objective", "square chords"},
    {"max_error", "largest distance to the target", "chords"},
    {"preserved_percent", "preserved, mean", "%"},
    {"lost_mean", "lost, mean", "triangles"},
    {"triangles_mean", "triangles, mean", ""},
    {"generated_triangles_mean", "of a fresh mesh, mean", ""},
    {"surplus_percent", "surplus, mean", "%"},
    {"gradation_bias", "gradation error, mean bias", ""},
    {"gradation_deviation", "gradation error, mean deviation", ""},
    {"generated_gradation_bias", "of a fresh mesh, bias", ""},
    {"generated_gradation_deviation", "of a fresh mesh, deviation", ""},
    {"remodel_ms_mean", "remodelling, mean", "ms"},
    {"generate_ms_mean", "generation, mean", "ms"},
    {"speedup", "speed-up", "times"},
    {"min_angle_deg", "smallest angle of all meshes", "degrees"},
    {"invalid_meshes", "invalid meshes", ""},
    {"recoveries", "recoveries by generation", ""},
    {"refreshes", "meshes generated afresh by the strategy", ""},
    {"seconds", "wall time", "seconds"},
    {"workers", "workers", ""},
    {"stopped", "stopped", ""},
    {"detail", "detail", ""},
    {"seed", "seed", ""},
    {"best", "best design", ""},
}};

void add_result(Report& report, const OptimiseResult& result) {
  const Json object = Json::parse(optimise_result_to_json(result));
  for (const Figure& figure : figures) {
    if (!object.contains(figure.key)) continue;
    const Json& value = object[figure.key];
    const bool for_people = !value.is_null() && !value.is_object() && value != "";
    if (for_people) {
      report.figure(figure.key, figure.label, value, figure.unit);
    } else {
      report.data(figure.key, value);
    }
  }
}

Status status_of(const OptimiseResult& result) {
  if (result.stopped != OptimiseStopped::done) return Status::limit;
  return result.invalid_meshes == 0 ? Status::done : Status::answer_is_no;
}

// Runs `repeat` times with the same seed: the same designs and meshes each time, only the times differ, and
// their medians replace those of the last run.
OptimiseResult run_repeatedly(const OptimiseCommand& command, const CstAirfoil& from, const CstAirfoil& to,
                              Progress& progress) {
  std::vector<double> seconds, remodel_ms, generate_ms;
  OptimiseResult result;
  for (int i = 0; i < command.repeat; ++i) {
    result = optimise(from, to, command.run, &progress);
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

// What became of the triangles of the mesh that the run started from.
void add_last_mesh_figures(Report& report, const OptimiseCommand& command) {
  const std::filesystem::path last = command.run.directory / "last.vtkhdf";
  if (command.run.start && std::filesystem::exists(last)) add_part_figures(report, read_mesh(last));
}

// A pool is a mesh for each sample of a generation, unless it is to have fewer.
void resolve_workers(OptimiseCommand& command) {
  command.run.workers = command.workers.value_or(command.strategy == "pool" ? 0 : 1);
}

Status run(OptimiseCommand& command) {
  resolve_workers(command);
  require_run_directory(command.run.directory);
  if (command.run.resume && command.repeat > 1) {
    throw Error(ErrorCode::argument, "--repeat",
                "found " + std::to_string(command.repeat) + " with --resume, expected 1");
  }
  const OptimiseStart start = read_start(command.start, command.meshing, command.run);
  const CstAirfoil& from = start.from;
  CstAirfoil to = load_airfoil(command.to, command.meshing.cst_degree);
  // A mesh with a blunt trailing edge keeps it.
  if (start.file) to.te_upper = from.te_upper, to.te_lower = from.te_lower;
  const Json options = options_json(command);

  Progress progress(progress_style(command.quiet), command.run.evaluations, "options: " + options.dump());
  const OptimiseResult result = run_repeatedly(command, from, to, progress);
  progress.finish();

  Report report;
  add_start_figures(report, command.start, start);
  report.figure("to", "to", command.to);
  report.data("options", options);
  add_result(report, result);
  add_last_mesh_figures(report, command);
  report.figure("directory", "run directory", command.run.directory.string());
  report.print(command.json);
  return status_of(result);
}

void add_strategy(CLI::App& app, OptimiseCommand& command) {
  std::vector<std::string> names;
  for (const RunStrategy& strategy : run_strategies) names.emplace_back(strategy.name);
  add_choice(
      app,
      {"--strategy", "STRATEGY", "renew",
       "renew (length scales are renewed, what is too dense is coarsened), chain (the paper's method to "
       "the letter, and all that imported meshes have), pool (renew, with as many workers as samples a "
       "generation), hub (renew, all designs from one mesh near their mean) or regenerate (chain, and "
       "generation where a criterion asks for it)"},
      names, [&](std::size_t choice) {
        command.strategy = run_strategies[choice].name;
        command.run.remodel.strategy = run_strategies[choice].step;
        command.run.use = run_strategies[choice].use;
      });
  add_integer(
      app,
      {"--workers", "W", "1, pool: as many as samples a generation",
       "Living meshes; a design goes to the worker whose last one is nearest. The result depends on it; "
       "1 to 1000"},
      {.low = 1, .high = 1000},
      [&](std::int64_t value) { command.workers = static_cast<std::size_t>(value); });
  add_integer(app,
              {"--threads", "T", "as many as cores, at most one a worker",
               "Workers that evaluate at the same time. The result does not depend on it; 1 to 1000"},
              {.low = 1, .high = 1000},
              [&](std::int64_t value) { command.run.threads = static_cast<std::size_t>(value); });
}

void add_search_options(CLI::App& app, OptimiseOptions& run) {
  add_real(app, {"--sigma", "S", "0.05", "Initial standard deviation of the coefficients: above 0, no unit"},
           {.low = 0.0, .high = 1e6, .above_low = true}, [&](double value) { run.sigma = value; });
  add_integer(app, {"--seed", "N", "1", "Seed of the samples: the same seed gives the same run; at least 0"},
              {.low = 0}, [&](std::int64_t value) { run.seed = static_cast<std::uint64_t>(value); });
  const auto add_count = [&](const OptionText& text, std::int64_t low, std::size_t& target) {
    add_integer(app, text, {.low = low, .high = 1'000'000'000},
                [&target](std::int64_t value) { target = static_cast<std::size_t>(value); });
  };
  add_count({"--evaluations", "N", "9000", "Feasible designs, one remodelling each: at least 1"}, 1,
            run.evaluations);
  add_count({"--compare-every", "K", "0",
             "Every K-th evaluation also generates a fresh mesh of the design; 0: never"},
            0, run.compare_every);
  add_count({"--checkpoint-every", "K", "500",
             "Evaluations between checkpoints; 0: only at the start, the end and an interrupt"},
            0, run.checkpoint_every);
}

}  // namespace

void add_optimise_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<OptimiseCommand>();
  CLI::App& app = add_subcommand(program, "optimise",
                                 "Changes one airfoil into another by CMA-ES, remodelling one living mesh",
                                 [command, &action] { action = [command] { return run(*command); }; });
  add_optimise_start_options(app, command->start);
  add_text(app, {"--to", "SHAPE", "", "Airfoil whose points the design is to interpolate"},
           Presence::required, command->to);
  add_text(app, {"-o,--output", "DIR", "", "Run directory: new, empty or that of a run"}, Presence::required,
           [command](const std::string& text) { command->run.directory = text; });
  add_meshing_options(app, command->meshing);
  add_remodel_options(app, command->run.remodel);
  add_strategy(app, *command);
  add_search_options(app, command->run);
  add_flag(app, "--resume", "Go on from the checkpoint in the run directory", command->run.resume);
  add_repeat(app, command->repeat);
  add_flag(app, "--quiet", "No progress and no options on standard error", command->quiet);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
