// The search of a design problem, from its start to fresh meshes of its best design.

#include <algorithm>
#include <cmath>
#include <thread>

#include "aero/design_stages.h"
#include "aero/fresh_flows.h"
#include "aero/outlet_numbers.h"
#include "aero/resolved_problem.h"
#include "remodel/design_run.h"

namespace remodel {
namespace {

// Asks a run's observer between the steps of meshes and flows.
class AskingObserver final : public StepObserver {
 public:
  explicit AskingObserver(OptimiseObserver* observer) : observer_(observer) {}
  bool cancelled() override { return observer_ != nullptr && observer_->cancelled(); }

 private:
  OptimiseObserver* observer_;
};

// Steps that follow gradients are of one design at a time.
std::size_t workers_of(const DesignProblem& problem) {
  return problem.designer == "cmaes" ? problem.workers : 1;
}

OptimiseOptions options_of(const DesignProblem& problem, const ResolvedProblem& parts,
                           const DesignRunOptions& options, StepObserver& observer) {
  OptimiseOptions result;
  result.domain = problem.domain;
  result.quality.gradation = gradation_of(problem);
  result.remodel.observer = &observer;
  result.strategy = design_strategy;
  result.reference_slack_deg = design_slack_deg;
  result.evaluations = problem.evaluations;
  result.constraint_tolerance = problem.constraint_tolerance;
  result.workers = workers_of(problem);
  result.threads = options.threads;
  if (result.workers > 1) result.ranks = options.ranks;
  result.checkpoint_every = 5;
  result.keep_finished = true;
  result.fail_at_limits = true;
  result.resume = options.resume, result.overwrite = options.overwrite;
  result.directory = options.directory;
  if (parts.first_design != parts.space->start()) result.first_design = parts.first_design;
  return result;
}

// What the search took: the first design's flows were found cold.
void add_cost(const DesignRun& run, DesignResult& result) {
  result.start_objective = run.start_objective();
  result.flows = run.rows.size() * run.points.size();
  result.gradients = run.with_gradients() ? result.flows : 0;
  result.replacements = static_cast<std::size_t>(std::count_if(
      run.rows.begin(), run.rows.end(), [](const EvaluationRecord& row) { return row.changed() != 0; }));
  const auto first = run.rows.front().outputs.find("flow_seconds");
  if (first != run.rows.front().outputs.end())
    result.cold_equivalents = (run.sum("flow_seconds") + run.sum("gradient_seconds")) / first->second;
}

// What has to be known of the best design's flows on the run's own mesh.
void add_warnings(const DesignRun& run, DesignResult& result) {
  for (std::size_t i = 0; i < run.points.size(); ++i) {
    const auto found = result.search.outputs.find(output_name("total_pressure", i));
    if (found == result.search.outputs.end()) continue;
    const std::string warning = total_pressure_warning(
        found->second, entering_total_pressure(run.points[i], run.space->walls(run.best_design())));
    if (!warning.empty()) result.detail += (result.detail.empty() ? "" : "; ") + warning;
  }
}

void add_run(const DesignRun& run, DesignResult& result) {
  result.constraints = run.violations();
  add_cost(run, result);
  add_warnings(run, result);
  if (!run.has_best())
    result.detail = run.why_no_design() + "; best.json is the start" +
                    (result.detail.empty() ? "" : "; " + result.detail);
}

}  // namespace

CrewWork design_work(const DesignProblem& problem) {
  if (workers_of(problem) == 1) return flow_points_work(problem);
  struct Parts {
    explicit Parts(const DesignProblem& of)
        : parts(resolved(of, "design problem")),
          evaluator(flow_evaluator(of, *parts.space)),
          options(options_of(of, parts, {.threads = 1}, silent)),
          work(optimise_work(*parts.space, *evaluator, options,
                             make_designer(of, *parts.space)->population())) {}
    StepObserver silent;
    ResolvedProblem parts;
    std::unique_ptr<Evaluator> evaluator;
    OptimiseOptions options;
    CrewWork work;
  };
  const auto parts = std::make_shared<Parts>(problem);
  return [parts](const std::string& bytes, const std::function<bool()>& cancelled) {
    return parts->work(bytes, cancelled);
  };
}

namespace {

SearchOnMesh search_on_mesh(const DesignProblem& problem, const DesignRunOptions& options,
                            const std::string& carried, OptimiseObserver* observer) {
  const ResolvedProblem parts = resolved(problem, "design problem");
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t threads = options.threads != 0 ? options.threads : cores, workers = workers_of(problem);
  const std::unique_ptr<Evaluator> evaluator =
      flow_evaluator(problem, *parts.space, std::max<std::size_t>(1, threads / workers),
                     workers == 1 ? options.ranks : nullptr, options.on_flow_step);
  const std::unique_ptr<Designer> designer = make_designer(problem, *parts.space);
  if (!carried.empty()) designer->carry(carried, "designer");
  AskingObserver asking(observer);
  DesignResult result;
  result.search =
      optimise(*parts.space, *designer, *evaluator, options_of(problem, parts, options, asking), observer);
  result.stopped = result.search.stopped != OptimiseStopped::done ? name_of(result.search.stopped)
                   : designer->finished()                         ? "done"
                                                                  : "evaluations";
  result.converged = std::isfinite(result.search.objective) && designer->finished();
  result.detail = result.search.detail;
  result.named = parts.space->named(result.search.best_design);
  result.best = parts.space->text(result.search.best_design);
  if (result.search.evaluations != 0) add_run(read_design_run(options.directory), result);
  return {std::move(result), designer->state()};
}

DesignResult search_of(const DesignProblem& problem, const DesignRunOptions& options,
                       OptimiseObserver* observer) {
  if (!problem.coarse_points.empty())
    return search_coarse_to_fine(problem, options, search_on_mesh, observer);
  AtFirstDesign watched(observer, [&] {
    if (options.overwrite) remove_stages(options.directory, 1);
  });
  return search_on_mesh(problem, options, {}, &watched).result;
}

// The best design on fresh meshes, and the one that the search began with: an estimate of the gain needs
// both.
void verify(const DesignProblem& problem, const DesignRunOptions& options, StepObserver& observer,
            DesignResult& result) {
  const ResolvedProblem parts = resolved(problem, "design problem");
  const auto add = [&](const std::vector<double>& design, std::vector<FreshFlow>& flows) {
    return add_fresh_flows(problem, parts, design, observer, options.on_flow_step, flows);
  };
  Stopped stopped = add(result.search.best_design, result.verified);
  if (parts.first_design == result.search.best_design)
    result.verified_start = result.verified;
  else if (stopped == Stopped::done)
    stopped = add(parts.first_design, result.verified_start);
  if (stopped == Stopped::interrupted) result.verified.clear(), result.verified_start.clear();
  if (!result.verified.empty()) write_fresh(result, options.directory);
  if (stopped != Stopped::done) result.stopped = name_of(stopped);
}

}  // namespace

DesignResult run_design(const DesignProblem& given, const DesignRunOptions& options,
                        OptimiseObserver* observer) {
  const DesignProblem problem = with_first_design(given);
  DesignResult result = search_of(problem, options, observer);
  AskingObserver asking(observer);
  if (result.search.stopped == OptimiseStopped::done && std::isfinite(result.search.objective) &&
      !problem.verify.empty())
    verify(problem, options, asking, result);
  return result;
}

}  // namespace remodel
