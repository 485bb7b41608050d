// remodel design PROBLEM.json -o DIR: a section designed by flows on one living mesh.

#include <cmath>
#include <memory>
#include <optional>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "launched.h"
#include "number_text.h"
#include "optimise_start.h"
#include "outputs.h"
#include "page_command.h"
#include "progress.h"
#include "ranks.h"
#include "remodel/design_run.h"
#include "remodel/error.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct DesignCommand {
  std::string problem;
  std::optional<DesignStart> start;
  DesignRunOptions run;
  RanksOptions ranks;
  bool quiet = false, json = false;
};

// A figure that there may be none of.
void add_figure(Report& report, const std::string& key, const std::string& label,
                const std::optional<double>& value) {
  if (value) return report.figure(key, label, *value);
  report.data(key, nullptr);
  report.line(label, "none");
}

// What the search took.
void add_cost(Report& report, const DesignResult& result) {
  add_figure(report, "start_objective", "objective of the start", result.start_objective);
  report.figure("flows", "flows", result.flows);
  report.figure("gradients", "of them with gradients", result.gradients);
  report.figure("replacements", "designs for which triangles were replaced", result.replacements);
  if (result.cold_equivalents)
    report.figure("cold_equivalents", "flows and gradients, in cold solves of the start",
                  *result.cold_equivalents);
}

// By how much the best design, or the least violated one, violates each constraint.
void add_constraints(Report& report, const std::vector<NamedNumber>& constraints) {
  Json by = Json::object();
  for (const auto& [name, violation] : constraints) by[name] = violation;
  report.data("constraints", by);
  for (const auto& [name, violation] : constraints)
    report.line("constraint: " + name, violation == 0.0 ? "kept" : "violated by " + short_text(violation));
}

// HISTORY[:N]
DesignStart start_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return {.history = text};
  const std::string number = text.substr(colon + 1);
  const bool is_number =
      !number.empty() && number.size() < 10 && number.find_first_not_of("0123456789") == std::string::npos;
  if (colon == 0 || (!is_number && number != "best"))
    throw Error(
        ErrorCode::argument, "--start",
        "found '" + text + "', expected a run directory, or one with the number of a design behind a colon");
  DesignStart start{.history = text.substr(0, colon)};
  if (is_number) start.design = std::stoull(number);
  return start;
}

void require_given(const DesignCommand& command) {
  if (command.problem.empty() || command.run.directory.empty())
    throw Error(ErrorCode::argument, command.problem.empty() ? "PROBLEM" : "--output",
                "is missing, expected a design problem and -o, a run directory");
}

void require_possible(const DesignCommand& command) {
  require_run_directory(command.run.directory);
  if (command.run.resume && command.run.overwrite)
    throw Error(ErrorCode::argument, "--overwrite", "found with --resume, expected one of them");
}

void add_best(Report& report, const DesignResult& result) {
  const OptimiseResult& search = result.search;
  report.figure("evaluations", "designs evaluated", search.evaluations);
  report.figure("full_adjustments", "full adjustments", search.full_adjustments);
  const bool is_found = std::isfinite(search.objective);
  add_figure(report, "objective", "best objective",
             is_found ? std::optional(search.objective) : std::nullopt);
  for (const auto& [name, value] : search.outputs)
    if (name == "connectivity" || name == "factorisations")
      report.figure(name, name, static_cast<std::uint64_t>(value));
    else
      report.figure(name, name, value);
  for (const NamedNumber& number : result.named) report.figure(number.name, number.name, number.value);
}

std::string text_of(const FreshFlow& fresh) {
  if (!fresh.converged) return "no flow was found";
  std::string text =
      "CL " + Json(fresh.cl).dump() + ", CD " + Json(fresh.cd).dump() + ", CM " + Json(fresh.cm).dump();
  for (const NamedNumber& number : fresh.outlets)
    text += ", " + number.name + " " + Json(number.value).dump();
  text += ", on " + std::to_string(fresh.vertices) + " vertices";
  if (!fresh.warning.empty()) text += " (" + fresh.warning + ")";
  for (const auto& [name, excess] : fresh.violated)
    text += ", violates '" + name + "' by " + short_text(excess);
  if (fresh.error) text += ", CD lacks about " + short_text(fresh.error->cd);
  return text;
}

void add_fresh(Report& report, const DesignResult& result) {
  for (const FreshFlow& fresh : result.verified_start)
    report.line("start on a fresh mesh, I = " + std::to_string(fresh.points), text_of(fresh));
  for (const FreshFlow& fresh : result.verified)
    report.line("fresh mesh, I = " + std::to_string(fresh.points), text_of(fresh));
  report.data("verified", Json::parse(fresh_json(result.verified)));
  report.data("verified_start", Json::parse(fresh_json(result.verified_start)));
}

// The meshes of a search from coarse to fine.
void add_stages(Report& report, const std::vector<DesignStage>& stages) {
  for (const DesignStage& stage : stages)
    report.line("mesh of I = " + std::to_string(stage.points),
                std::to_string(stage.evaluations) + " designs, objective " +
                    (stage.objective ? short_text(*stage.objective) : "none") + ", " +
                    short_text(stage.seconds) + " seconds");
  report.data("stages", Json::parse(stages_json(stages)));
}

DesignProblem problem_of(const DesignCommand& command) {
  DesignProblem problem = read_design_problem(command.problem);
  if (!command.start) return problem;
  problem.start = command.start;
  return with_first_design(std::move(problem), command.problem);
}

// Under mpirun.
CrewWork work_of_ranks(const DesignCommand& command) {
  const DesignProblem problem = problem_of(command);
  if (!problem.coarse_points.empty())
    throw Error(ErrorCode::argument, command.problem,
                "found meshes from coarse to fine, expected one mesh under mpirun");
  if (problem.points.size() == 1 && (problem.designer != "cmaes" || problem.workers == 1))
    throw Error(ErrorCode::argument, command.problem,
                "found one point of flow and one living mesh, expected several points, or \"cmaes\" with "
                "'workers': " +
                    std::to_string(launched_ranks()) +
                    " MPI ranks have no more than one flow to find at a time");
  return design_work(problem);
}

Status run_search(DesignCommand& command, PostedJobs* jobs) {
  require_possible(command);
  const DesignProblem problem = problem_of(command);
  warn(problem.warnings);
  command.run.ranks = jobs;
  Progress progress(progress_style(command.quiet), problem.evaluations * (1 + problem.coarse_points.size()),
                    "problem: " + command.problem);
  command.run.on_flow_step = [&](const FlowProgress& at) { progress.flow_step(at); };
  const DesignResult result = run_design(problem, command.run, &progress);
  progress.finish();

  Report report;
  report.figure("problem", "problem", command.problem);
  add_best(report, result);
  if (result.search.evaluations != 0) {
    add_constraints(report, result.constraints);
    add_cost(report, result);
  }
  if (!result.detail.empty()) report.figure("detail", "detail", result.detail);
  report.figure("seconds", "wall time", result.search.seconds, "seconds");
  report.figure("stopped", "stopped", result.stopped);
  report.figure("converged", "converged", result.converged);
  add_fresh(report, result);
  if (!result.stages.empty()) add_stages(report, result.stages);
  report.data("best", Json::parse(result.best));
  report.figure("directory", "run directory", command.run.directory.string());
  report.print(command.json);
  if (result.stopped != "done") return Status::limit;
  return std::isfinite(result.search.objective) ? Status::done : Status::answer_is_no;
}

Status run(DesignCommand& command) {
  require_given(command);
  return with_posted_jobs(
      command.ranks, [&] { return work_of_ranks(command); },
      [&](PostedJobs* jobs) { return run_search(command, jobs); });
}

}  // namespace

void add_design_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<DesignCommand>();
  CLI::App& app =
      add_subcommand(program, "design", "Designs an airfoil by flows and their gradients on one living mesh",
                     [command, &action] {
                       if (!action)
                         action = [command] { return run(*command); };  // else its subcommand was given
                     });
  add_text(app, {"problem", "PROBLEM", "", "Design problem, a JSON file: docs/design.md"}, Presence::optional,
           command->problem);
  add_text(
      app,
      {"-o,--output", "DIR", "", "Run directory: new or empty; that of a run with --resume or --overwrite"},
      Presence::optional, command->run.directory);
  add_text(app,
           {"--start", "RUN[:N]", "",
            "Begin with design N, the best one unless given, of another run with the same variables"},
           Presence::optional, [=](const std::string& text) { command->start = start_of(text); });
  add_flag(app, "--resume", "Continue from the checkpoint in the run directory", command->run.resume);
  add_flag(app, "--overwrite", "Replace the run that the run directory holds", command->run.overwrite);
  add_integer(
      app,
      {"--threads", "T", "as many as cores",
       "Flows of the problem's points that are looked for at the same time. The result does not depend "
       "on it; 1 to 1000"},
      {.low = 1, .high = 1000}, command->run.threads);
  add_rank_option(app, command->ranks);
  add_flag(app, "--quiet", "No progress on standard error", command->quiet);
  add_json_flag(app, command->json);
  add_page_command(app, action,
                   {.description = "Reports a run on one page, with everything in it",
                    .directory_help = "Run directory of `remodel design`, finished or not",
                    .key = "run",
                    .write = write_design_page});
}

}  // namespace remodel::app
