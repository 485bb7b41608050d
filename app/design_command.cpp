// remodel design PROBLEM.json -o DIR: a section designed by flows on one living mesh.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

#include "arguments.h"
#include "command.h"
#include "design_problem.h"
#include "design_report.h"
#include "design_run.h"
#include "figures.h"
#include "interrupt.h"
#include "number_text.h"
#include "optimise_start.h"
#include "outputs.h"
#include "progress.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/optimise.h"

namespace remodel::app {
namespace {

struct DesignCommand {
  std::string problem;
  OptimiseOptions run;
  std::size_t threads = 0;
  bool quiet = false, json = false;
};

// The names and excesses of a point's constraints that its flow on a fresh mesh violates.
Json violated_by(const DesignProblemFile& problem, std::size_t point, const Mesh& mesh,
                 const FlowResult& flow) {
  Json result = Json::object();
  if (!flow.converged()) return result;
  for (const FlowConstraint& constraint : problem.flow)
    if (constraint.point == point)
      if (const double excess = excess_of(constraint, mesh, flow); excess > problem.constraint_tolerance)
        result[constraint.name] = excess;
  return result;
}

// The best design on fresh meshes, which no search has seen.
struct Verification {
  Json list = Json::array();        // of what was finished
  Stopped stopped = Stopped::done;  // or what kept one of the meshes or flows from being finished
};

Verification verified(const DesignProblemFile& problem, const FlowSpace& space,
                      std::span<const double> design, StepObserver& observer) {
  Verification result;
  for (const int points : problem.verify) {
    const double gradation = problem.gradation * points / problem.domain.points;
    const GenerateResult made =
        generate(space.domain_with(design, points), {.gradation = gradation}, &observer);
    result.stopped = made.stopped;
    if (made.stopped != Stopped::done) return result;
    const Mesh& mesh = made.mesh;
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      const FlowResult flow = solve_section(mesh, problem.points[i].conditions, space.half(), &observer);
      if (flow.status == FlowStatus::interrupted) {
        result.stopped = Stopped::interrupted;
        return result;
      }
      result.list.push_back({{"points", points},
                             {"vertices", mesh.freeze().points.size()},
                             {"mach", flow.mach},
                             {"alpha_deg", flow.alpha_deg},
                             {"cl", flow.cl},
                             {"cd", flow.cd},
                             {"cm", flow.cm},
                             {"converged", flow.converged()},
                             {"violated", violated_by(problem, i, mesh, flow)},
                             {"seconds", flow.seconds}});
    }
  }
  return result;
}

// A figure that there may be none of.
void add_figure(Report& report, const std::string& key, const std::string& label,
                const std::optional<double>& value) {
  if (value) return report.figure(key, label, *value);
  report.data(key, nullptr);
  report.line(label, "none");
}

// What the search took: the first design's flows were found cold.
void add_cost(Report& report, const DesignRun& run) {
  const auto first = run.rows.front().outputs.find("flow_seconds");
  const std::size_t flows = run.rows.size() * run.conditions.size();
  const auto replaced = std::count_if(run.rows.begin(), run.rows.end(),
                                      [](const EvaluationRecord& row) { return row.changed() != 0; });
  add_figure(report, "start_objective", "objective of the start", run.start_objective());
  report.figure("flows", "flows", flows);
  report.figure("gradients", "of them with gradients", run.with_gradients() ? flows : 0);
  report.figure("replacements", "designs for which triangles were replaced", replaced);
  if (first != run.rows.front().outputs.end())
    report.figure("cold_equivalents", "flows and gradients, in cold solves of the start",
                  (run.sum("flow_seconds") + run.sum("gradient_seconds")) / first->second);
}

// By how much the best design, or the least violated one, violates each constraint.
void add_constraints(Report& report, const DesignRun& run) {
  const Json by = run.violations();
  report.data("constraints", by);
  for (const auto& [name, violation] : by.items())
    report.line("constraint: " + name,
                violation == 0.0 ? "kept" : "violated by " + short_text(violation.get<double>()));
}

void require_possible(const DesignCommand& command) {
  if (command.problem.empty() || command.run.directory.empty())
    throw Error(ErrorCode::argument, command.problem.empty() ? "PROBLEM" : "--output",
                "is missing, expected a design problem and -o, a run directory");
  require_run_directory(command.run.directory);
  if (command.run.resume && command.run.overwrite)
    throw Error(ErrorCode::argument, "--overwrite", "found with --resume, expected one of them");
}

// The run's options, of which the problem has some.
OptimiseOptions options_of(const DesignCommand& command, const DesignProblemFile& problem,
                           StepObserver& observer) {
  OptimiseOptions options = command.run;
  options.domain = problem.domain;
  options.quality.gradation = problem.gradation;
  options.remodel.observer = &observer;
  options.strategy = MeshStrategy::morph;
  options.evaluations = problem.evaluations;
  options.constraint_tolerance = problem.constraint_tolerance;
  options.workers = 1;
  options.checkpoint_every = 5;
  options.keep_finished = true;
  return options;
}

void add_result(Report& report, const OptimiseResult& result, const FlowSpace& space) {
  report.figure("evaluations", "designs evaluated", result.evaluations);
  report.figure("full_adjustments", "full adjustments", result.full_adjustments);
  const bool is_found = std::isfinite(result.objective);
  add_figure(report, "objective", "best objective",
             is_found ? std::optional(result.objective) : std::nullopt);
  for (const auto& [name, value] : result.outputs)
    if (name == "connectivity" || name == "factorisations")
      report.figure(name, name, static_cast<std::uint64_t>(value));
    else
      report.figure(name, name, value);
  for (const NamedNumber& number : space.named(result.best_design))
    report.figure(number.name, number.name, number.value);
}

std::string text_of(const Json& fresh) {
  if (fresh["converged"] != true) return "no flow was found";
  std::string text = "CL " + fresh["cl"].dump() + ", CD " + fresh["cd"].dump() + ", CM " + fresh["cm"].dump();
  for (const auto& [name, excess] : fresh["violated"].items())
    text += ", violates '" + name + "' by " + short_text(excess.get<double>());
  return text;
}

// The file says of which design it is: a search that goes on may find a better one.
void add_verified(Report& report, const Json& fresh, const OptimiseResult& result,
                  const std::filesystem::path& directory) {
  for (const Json& entry : fresh) report.line("fresh mesh, I = " + entry["points"].dump(), text_of(entry));
  report.data("verified", fresh);
  if (fresh.empty()) return;
  const Json file = {{"design", result.best_design}, {"verified", fresh}};
  write_text_atomically(directory / "fresh.json", file.dump() + "\n");
}

std::string detail_of(const DesignRun& run, const OptimiseResult& result) {
  if (run.has_best()) return result.detail;
  return run.why_no_design() + "; best.json is the start" +
         (result.detail.empty() ? "" : "; " + result.detail);
}

void add_run(Report& report, const OptimiseResult& result, const std::filesystem::path& directory) {
  if (result.evaluations == 0) {
    if (!result.detail.empty()) report.figure("detail", "detail", result.detail);
    return;
  }
  const DesignRun run = read_design_run(directory);
  add_constraints(report, run);
  add_cost(report, run);
  if (const std::string detail = detail_of(run, result); !detail.empty())
    report.figure("detail", "detail", detail);
}

// Why the command ended: "done" where the search has by itself.
std::string stopped_by(const OptimiseResult& result, const Verification& fresh, const Designer& designer) {
  if (result.stopped != OptimiseStopped::done) return name_of(result.stopped);
  if (fresh.stopped != Stopped::done) return name_of(fresh.stopped);
  return designer.finished() ? "done" : "evaluations";
}

Status run(const DesignCommand& command) {
  require_possible(command);
  const DesignProblemFile problem = read_design_problem(command.problem);
  const std::unique_ptr<FlowSpace> space = problem.space();
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::unique_ptr<Evaluator> evaluator =
      make_flow_evaluator(problem, *space, command.threads != 0 ? command.threads : cores);
  const std::unique_ptr<Designer> designer = make_designer(problem, *space);
  Progress progress(progress_style(command.quiet), problem.evaluations, "problem: " + command.problem);
  const OptimiseOptions options = options_of(command, problem, progress.step_observer());
  const OptimiseResult result = optimise(*space, *designer, *evaluator, options, &progress);
  progress.finish();
  const bool is_found = std::isfinite(result.objective);
  Verification fresh;
  if (result.stopped == OptimiseStopped::done && is_found)
    fresh = verified(problem, *space, result.best_design, progress.step_observer());
  const std::string stopped = stopped_by(result, fresh, *designer);

  Report report;
  report.figure("problem", "problem", command.problem);
  add_result(report, result, *space);
  add_run(report, result, options.directory);
  report.figure("seconds", "wall time", result.seconds, "seconds");
  report.figure("stopped", "stopped", stopped);
  report.figure("converged", "converged", is_found && designer->finished());
  if (fresh.stopped != Stopped::interrupted) add_verified(report, fresh.list, result, options.directory);
  report.data("best", Json::parse(space->text(result.best_design)));
  report.figure("directory", "run directory", options.directory.string());
  report.print(command.json);
  if (stopped != "done") return Status::limit;
  return is_found ? Status::done : Status::answer_is_no;
}

struct DesignReportCommand {
  std::filesystem::path run;
  std::string output;
  bool json = false;
};

Status run(const DesignReportCommand& command) {
  const std::string page = command.output.empty() ? (command.run / "report.html").string() : command.output;
  require_writable_as(page, {".html"});
  const Json figures = write_design_report(command.run, page);
  Report report;
  report.figure("run", "run", command.run.string());
  for (const auto& [key, value] : figures.items()) report.figure(key, key, value);
  add_output_figures(report, {page});
  report.print(command.json);
  return Status::done;
}

void add_design_report_command(CLI::App& design, Action& action) {
  auto command = std::make_shared<DesignReportCommand>();
  CLI::App& app = add_subcommand(design, "report", "Reports a run on one page, with everything in it",
                                 [command, &action] { action = [command] { return run(*command); }; });
  add_text(app, {"DIR", "", "", "Run directory of `remodel design`, finished or not"}, Presence::required,
           [command](const std::string& text) { command->run = text; });
  add_text(app, {"-o,--output", "FILE", "DIR/report.html", "Page to write: .html"}, Presence::optional,
           command->output);
  add_json_flag(app, command->json);
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
      Presence::optional, [command](const std::string& text) { command->run.directory = text; });
  add_flag(app, "--resume", "Continue from the checkpoint in the run directory", command->run.resume);
  add_flag(app, "--overwrite", "Replace the run that the run directory holds", command->run.overwrite);
  add_integer(
      app,
      {"--threads", "T", "as many as cores",
       "Flows of the problem's points that are looked for at the same time. The result does not depend "
       "on it; 1 to 1000"},
      {.low = 1, .high = 1000},
      [command](std::int64_t value) { command->threads = static_cast<std::size_t>(value); });
  add_flag(app, "--quiet", "No progress on standard error", command->quiet);
  add_json_flag(app, command->json);
  add_design_report_command(app, action);
}

}  // namespace remodel::app
