// remodel design PROBLEM.json -o DIR: a section designed by flows on one living mesh.

#include <cmath>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "design_problem.h"
#include "figures.h"
#include "interrupt.h"
#include "optimise_start.h"
#include "progress.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/optimise.h"

namespace remodel::app {
namespace {

struct DesignCommand {
  std::string problem;
  OptimiseOptions run;
  bool quiet = false, json = false;
};

// The last design on fresh meshes, which no search has seen.
Json verified(const DesignProblemFile& problem, const CstAirfoil& airfoil) {
  Json list = Json::array();
  for (const int points : problem.verify) {
    AirfoilDomainOptions domain = problem.domain;
    domain.points = points;
    const double gradation = problem.gradation * points / problem.domain.points;
    const FrozenMesh mesh = generate(airfoil_domain(airfoil, domain), {.gradation = gradation}).mesh.freeze();
    for (const DesignPoint& point : problem.points) {
      const FlowResult flow = solve_flow(mesh, point.conditions);
      list.push_back({{"points", points},
                      {"vertices", mesh.points.size()},
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

Status run(DesignCommand& command) {
  require_run_directory(command.run.directory);
  if (command.run.resume && command.run.overwrite)
    throw Error(ErrorCode::argument, "--overwrite", "found with --resume, expected one of them");
  const DesignProblemFile problem = read_design_problem(command.problem);
  const SectionSpace space(problem);
  const std::unique_ptr<Evaluator> evaluator = make_flow_evaluator(problem, space);
  const std::unique_ptr<Designer> designer = make_designer(problem, space);
  command.run.domain = problem.domain;
  command.run.quality.gradation = problem.gradation;
  command.run.strategy = MeshStrategy::chain;
  command.run.evaluations = problem.evaluations;
  command.run.workers = 1;
  command.run.checkpoint_every = 5;
  Progress progress(progress_style(command.quiet), problem.evaluations, "problem: " + command.problem);
  const OptimiseResult result = optimise(space, *designer, *evaluator, command.run, &progress);
  progress.finish();

  const CstAirfoil best = space.airfoil(result.best_design);
  Report report;
  report.figure("problem", "problem", command.problem);
  report.figure("evaluations", "designs evaluated", result.evaluations);
  report.figure("full_adjustments", "full adjustments", result.full_adjustments);
  report.figure("objective", "best objective", result.objective);
  for (const auto& [name, value] : result.outputs) report.figure(name, name, value);
  report.figure("seconds", "wall time", result.seconds, "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  if (!result.detail.empty()) report.figure("detail", "detail", result.detail);
  const bool done = result.stopped == OptimiseStopped::done;
  const Json fresh = done && std::isfinite(result.objective) ? verified(problem, best) : Json::array();
  for (const Json& entry : fresh)
    report.line("fresh mesh, I = " + entry["points"].dump(),
                "CL " + entry["cl"].dump() + ", CD " + entry["cd"].dump() +
                    (entry["converged"] == true ? "" : ", no flow was found"));
  report.data("verified", fresh);
  report.data("best", Json::parse(airfoil_to_json(best)));
  report.figure("directory", "run directory", command.run.directory.string());
  report.print(command.json);
  if (!done) return Status::limit;
  return std::isfinite(result.objective) ? Status::done : Status::answer_is_no;
}

}  // namespace

void add_design_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<DesignCommand>();
  CLI::App& app =
      add_subcommand(program, "design", "Designs an airfoil by flows and their gradients on one living mesh",
                     [command, &action] { action = [command] { return run(*command); }; });
  add_text(app, {"problem", "PROBLEM", "", "Design problem, a JSON file: docs/design.md"}, Presence::required,
           command->problem);
  add_text(
      app,
      {"-o,--output", "DIR", "", "Run directory: new or empty; that of a run with --resume or --overwrite"},
      Presence::required, [command](const std::string& text) { command->run.directory = text; });
  add_flag(app, "--resume", "Continue from the checkpoint in the run directory", command->run.resume);
  add_flag(app, "--overwrite", "Replace the run that the run directory holds", command->run.overwrite);
  add_flag(app, "--quiet", "No progress on standard error", command->quiet);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
