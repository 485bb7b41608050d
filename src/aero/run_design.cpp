// The search of a design problem, from its start to fresh meshes of its best design.

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "aero/design_stages.h"
#include "aero/outlet_numbers.h"
#include "aero/resolved_problem.h"
#include "aero/table_cell.h"
#include "flow/solution.h"
#include "remodel/design_run.h"
#include "remodel/flow_error.h"
#include "remodel/generate.h"
#include "remodel/io.h"

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

// With friction away from the tops of layers.
double gradation_of(const DesignProblem& problem) {
  const bool has_friction = problem.points.front().model != FlowModel::euler;
  return problem.gradation.value_or(problem.domain.points / (has_friction ? 37.5 : 50.0));
}

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

// The constraints of a point that its flow on a fresh mesh violates.
std::vector<NamedNumber> violated_by(const ResolvedProblem& problem, double tolerance, std::size_t point,
                                     const Domain& walls, const FrozenMesh& frozen, const FlowResult& flow) {
  std::vector<NamedNumber> result;
  if (!flow.converged() || !flow.lift_determined) return result;
  for (const ResolvedProblem::FlowLimit& limit : problem.flow) {
    if (limit.point != point) continue;
    const double value = problem.functions[limit.function]->at({walls, frozen, flow}).value;
    const double excess = limit.factor * (value - limit.limit);
    if (excess > tolerance) result.push_back({limit.name, excess});
  }
  return result;
}

// A mesh that no search has seen, with layers where the space has them.
struct FreshMesh {
  Mesh plain;  // without layers
  FrozenMesh frozen;
  Stopped stopped = Stopped::done;
};

FreshMesh fresh_mesh(const FlowSpace& space, const Domain& walls, double gradation, StepObserver& observer) {
  FreshMesh fresh;
  if (space.layers() != nullptr) {
    const LayeredGenerateResult made =
        generate_layered(walls, space.layers()->options(), {.gradation = gradation}, &observer);
    fresh.frozen = made.mesh.freeze(), fresh.stopped = made.stopped;
  } else {
    GenerateResult made = generate(walls, {.gradation = gradation}, &observer);
    fresh.frozen = made.mesh.freeze(), fresh.stopped = made.stopped;
    fresh.plain = std::move(made.mesh);
  }
  return fresh;
}

FlowResult flow_through(const FreshMesh& mesh, const FlowSpace& space, const DesignPoint& point,
                        StepObserver& observer) {
  const FlowOptions options = design_flow_options(space, point, &observer);
  FlowResult flow = mesh.plain.empty() ? solve_flow(mesh.frozen, point.conditions, options)
                                       : solve_flow(mesh.plain, point.conditions, options);
  return space.half() ? whole_of(std::move(flow)) : flow;
}

// By the two finest meshes of each point, if flows through both were found.
void add_errors(std::size_t points, std::vector<FreshFlow>& verified) {
  for (std::size_t point = 0; point < points; ++point) {
    FreshFlow *finest = nullptr, *next = nullptr;
    for (std::size_t i = point; i < verified.size(); i += points) {
      FreshFlow& flow = verified[i];
      if (finest == nullptr || flow.points > finest->points) {
        next = finest, finest = &flow;
      } else if (flow.points < finest->points && (next == nullptr || flow.points > next->points)) {
        next = &flow;
      }
    }
    if (next == nullptr || !finest->converged || !next->converged) continue;
    const double order = order_of_errors(finest->mach_max);
    const double rest = 1.0 / (std::pow(double(finest->points) / next->points, order) - 1.0);
    finest->error = {.cl = rest * (finest->cl - next->cl),
                     .cd = rest * (finest->cd - next->cd),
                     .cm = rest * (finest->cm - next->cm),
                     .order = order};
  }
}

void add_outlets(const DesignPoint& point, const FlowView& of, FreshFlow& fresh) {
  for (const auto& [name, value] : outlet_numbers(point, of)) {
    fresh.outlets.push_back({name, value});
    if (name != "total_pressure") continue;
    const std::string warning = total_pressure_warning(value, entering_total_pressure(point, of.domain));
    if (!warning.empty()) fresh.warning += (fresh.warning.empty() ? "" : "; ") + warning;
  }
}

// What kept one of the meshes or flows from being finished, or done.
Stopped verify(const DesignProblem& problem, const ResolvedProblem& parts, std::span<const double> design,
               StepObserver& observer, std::vector<FreshFlow>& verified) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const int points : problem.verify) {
    const Domain walls = parts.space->domain_with(design, points);
    const FreshMesh mesh =
        fresh_mesh(*parts.space, walls, gradation_of(problem) * points / problem.domain.points, observer);
    if (mesh.stopped != Stopped::done) return mesh.stopped;
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      const FlowResult flow = flow_through(mesh, *parts.space, problem.points[i], observer);
      if (flow.status == FlowStatus::interrupted) return Stopped::interrupted;
      verified.push_back(
          {.points = points,
           .vertices = mesh.frozen.points.size(),
           .mach = flow.mach,
           .alpha_deg = flow.alpha_deg,
           .cl = flow.lift_determined ? flow.cl : none,
           .cd = flow.cd,
           .cm = flow.lift_determined ? flow.cm : none,
           .cd_pressure = flow.friction ? std::optional(flow.friction->cd_pressure) : std::nullopt,
           .cd_friction = flow.friction ? std::optional(flow.friction->cd_friction) : std::nullopt,
           .outlets = {},
           .warning = joined(flow.warnings),
           .converged = flow.converged(),
           .violated = violated_by(parts, problem.constraint_tolerance, i, walls, mesh.frozen, flow),
           .seconds = flow.seconds,
           .mach_max = remodel::flow::largest_mach(flow)});
      if (flow.converged()) add_outlets(problem.points[i], {walls, mesh.frozen, flow}, verified.back());
    }
  }
  add_errors(problem.points.size(), verified);
  return Stopped::done;
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

// The file says of which design it is: a search that goes on may find a better one.
void write_fresh(const DesignResult& result, const std::filesystem::path& directory) {
  const nlohmann::ordered_json file = {
      {"design", result.search.best_design},
      {"verified", nlohmann::ordered_json::parse(fresh_json(result.verified))}};
  write_text_atomically(directory / "fresh.json", file.dump() + "\n");
}

}  // namespace

std::string fresh_json(const std::vector<FreshFlow>& flows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FreshFlow& flow : flows) {
    nlohmann::ordered_json violated = nlohmann::ordered_json::object();
    for (const auto& [name, excess] : flow.violated) violated[name] = excess;
    list.push_back({{"points", flow.points},
                    {"vertices", flow.vertices},
                    {"mach", flow.mach},
                    {"alpha_deg", flow.alpha_deg},
                    {"cl", flow.cl},
                    {"cd", flow.cd},
                    {"cm", flow.cm},
                    {"converged", flow.converged},
                    {"violated", std::move(violated)},
                    {"seconds", flow.seconds},
                    {"mach_max", flow.mach_max}});
    if (flow.cd_pressure) list.back()["cd_pressure"] = *flow.cd_pressure;
    if (flow.cd_friction) list.back()["cd_friction"] = *flow.cd_friction;
    for (const NamedNumber& number : flow.outlets) list.back()[number.name] = number.value;
    if (!flow.warning.empty()) list.back()["warning"] = flow.warning;
    if (flow.error)
      list.back()["error"] = {{"cl", flow.error->cl},
                              {"cd", flow.error->cd},
                              {"cm", flow.error->cm},
                              {"order", flow.error->order}};
  }
  return list.dump();
}

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
                     workers == 1 ? options.ranks : nullptr);
  const std::unique_ptr<Designer> designer = make_designer(problem, *parts.space);
  if (!carried.empty()) designer->carry(carried, "designer");
  AskingObserver asking(observer);
  DesignResult result;
  result.search =
      optimise(*parts.space, *designer, *evaluator, options_of(problem, parts, options, asking), observer);
  const bool is_found = std::isfinite(result.search.objective);
  Stopped fresh = Stopped::done;
  if (result.search.stopped == OptimiseStopped::done && is_found) {
    fresh = verify(problem, parts, result.search.best_design, asking, result.verified);
    if (fresh == Stopped::interrupted) result.verified.clear();
    if (!result.verified.empty()) write_fresh(result, options.directory);
  }
  result.stopped = result.search.stopped != OptimiseStopped::done ? name_of(result.search.stopped)
                   : fresh != Stopped::done                       ? name_of(fresh)
                   : designer->finished()                         ? "done"
                                                                  : "evaluations";
  result.converged = is_found && designer->finished();
  result.detail = result.search.detail;
  result.named = parts.space->named(result.search.best_design);
  result.best = parts.space->text(result.search.best_design);
  if (result.search.evaluations != 0) add_run(read_design_run(options.directory), result);
  return {std::move(result), designer->state()};
}

}  // namespace

DesignResult run_design(const DesignProblem& given, const DesignRunOptions& options,
                        OptimiseObserver* observer) {
  const DesignProblem problem = with_first_design(given);
  if (!problem.coarse_points.empty())
    return search_coarse_to_fine(problem, options, search_on_mesh, observer);
  AtFirstDesign watched(observer, [&] {
    if (options.overwrite) remove_stages(options.directory, 1);
  });
  return search_on_mesh(problem, options, {}, &watched).result;
}

}  // namespace remodel
