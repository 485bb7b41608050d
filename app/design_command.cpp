// remodel design PROBLEM.json -o DIR: a section designed by flows on one living mesh.

#include <algorithm>
#include <cmath>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "design_problem.h"
#include "design_report.h"
#include "design_run.h"
#include "figures.h"
#include "interrupt.h"
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
  bool quiet = false, json = false;
};

// The last design on fresh meshes, which no search has seen.
Json verified(const DesignProblemFile& problem, const FlowSpace& space, std::span<const double> design) {
  Json list = Json::array();
  for (const int points : problem.verify) {
    const double gradation = problem.gradation * points / problem.domain.points;
    const Mesh mesh = generate(space.domain_with(design, points), {.gradation = gradation}).mesh;
    for (const DesignPoint& point : problem.points) {
      const FlowResult flow = solve_section(mesh, point.conditions, space.half());
      list.push_back({{"points", points},
                      {"vertices", mesh.freeze().points.size()},
                      {"mach", flow.mach},
                      {"alpha_deg", flow.alpha_deg},
                      {"cl", flow.cl},
                      {"cd", flow.cd},
                      {"cm", flow.cm},
                      {"converged", flow.converged()},
                      {"seconds", flow.seconds}});
    }
  }
  return list;
}

// What the search took: the first design's flows were found cold.
void add_cost(Report& report, const DesignRun& run) {
  const auto first = run.rows.front().outputs.find("flow_seconds");
  const double flows = static_cast<double>(run.rows.size() * run.conditions.size());
  const auto full = std::count_if(run.rows.begin(), run.rows.end(),
                                  [](const EvaluationRecord& row) { return row.full_adjustment; });
  report.figure("start_objective", "objective of the start", run.rows.front().objective);
  report.figure("flows", "flows", flows);
  report.figure("gradients", "of them with gradients", run.with_gradients() ? flows : 0.0);
  report.figure("replacements", "designs for which vertices were replaced",
                static_cast<std::ptrdiff_t>(run.rows.size()) - full);
  if (first != run.rows.front().outputs.end())
    report.figure("cold_equivalents", "flows and gradients, in cold solves of the start",
                  (run.sum("flow_seconds") + run.sum("gradient_seconds")) / first->second);
}

Status run(DesignCommand& command) {
  if (command.problem.empty() || command.run.directory.empty())
    throw Error(ErrorCode::argument, command.problem.empty() ? "PROBLEM" : "--output",
                "is missing, expected a design problem and -o, a run directory");
  require_run_directory(command.run.directory);
  if (command.run.resume && command.run.overwrite)
    throw Error(ErrorCode::argument, "--overwrite", "found with --resume, expected one of them");
  const DesignProblemFile problem = read_design_problem(command.problem);
  const std::unique_ptr<FlowSpace> space = problem.space();
  const std::unique_ptr<Evaluator> evaluator = make_flow_evaluator(problem, *space);
  const std::unique_ptr<Designer> designer = make_designer(problem, *space);
  command.run.domain = problem.domain;
  command.run.quality.gradation = problem.gradation;
  command.run.strategy = MeshStrategy::chain;
  command.run.evaluations = problem.evaluations;
  command.run.workers = 1;
  command.run.checkpoint_every = 5;
  Progress progress(progress_style(command.quiet), problem.evaluations, "problem: " + command.problem);
  const OptimiseResult result = optimise(*space, *designer, *evaluator, command.run, &progress);
  progress.finish();

  Report report;
  report.figure("problem", "problem", command.problem);
  report.figure("evaluations", "designs evaluated", result.evaluations);
  report.figure("full_adjustments", "full adjustments", result.full_adjustments);
  report.figure("objective", "best objective", result.objective);
  for (const auto& [name, value] : result.outputs) report.figure(name, name, value);
  for (const NamedNumber& number : space->named(result.best_design))
    report.figure(number.name, number.name, number.value);
  if (result.evaluations > 0) add_cost(report, read_design_run(command.run.directory));
  report.figure("seconds", "wall time", result.seconds, "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  report.figure("converged", "converged", designer->finished());
  if (!result.detail.empty()) report.figure("detail", "detail", result.detail);
  const bool done = result.stopped == OptimiseStopped::done;
  const Json fresh =
      done && std::isfinite(result.objective) ? verified(problem, *space, result.best_design) : Json::array();
  for (const Json& entry : fresh)
    report.line("fresh mesh, I = " + entry["points"].dump(),
                "CL " + entry["cl"].dump() + ", CD " + entry["cd"].dump() +
                    (entry["converged"] == true ? "" : ", no flow was found"));
  report.data("verified", fresh);
  if (!fresh.empty()) write_text_atomically(command.run.directory / "fresh.json", fresh.dump() + "\n");
  report.data("best", Json::parse(space->text(result.best_design)));
  report.figure("directory", "run directory", command.run.directory.string());
  report.print(command.json);
  if (!done) return Status::limit;
  return std::isfinite(result.objective) ? Status::done : Status::answer_is_no;
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
  add_flag(app, "--quiet", "No progress on standard error", command->quiet);
  add_json_flag(app, command->json);
  add_design_report_command(app, action);
}

}  // namespace remodel::app
