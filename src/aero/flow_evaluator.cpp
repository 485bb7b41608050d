// The evaluator of a design problem: the flows of all points on the living mesh, and their gradients.

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "aero/design_mesh.h"
#include "aero/first_flow.h"
#include "aero/flow_memory.h"
#include "aero/outlet_numbers.h"
#include "aero/posted_point.h"
#include "aero/resolved_problem.h"
#include "base/threads.h"
#include "design/posted_design.h"
#include "remodel/error.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

void add(std::vector<double>& to, double factor, const std::vector<double>& from) {
  to.resize(from.size(), 0.0);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += factor * from[i];
}

class FlowEvaluator final : public Evaluator {
 public:
  // ranks: have the flows of points found by a crew; null: by threads.
  FlowEvaluator(const DesignProblem& problem, const FlowSpace& space, std::size_t threads, PostedJobs* ranks,
                std::function<void(const FlowProgress&)> on_step)
      : problem_(problem),
        parts_(resolved(problem, "design problem")),
        space_(space),
        threads_(ranks == nullptr ? threads : problem.points.size()),
        ranks_(ranks),
        on_step_(std::move(on_step)) {
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      std::vector<std::size_t>& asked = asked_.emplace_back(1, 0);  // the objective is of each point
      for (const ResolvedProblem::FlowLimit& limit : parts_.flow)
        if (limit.point == i && std::find(asked.begin(), asked.end(), limit.function) == asked.end())
          asked.push_back(limit.function);
    }
    if (ranks_ != nullptr) run_ = identity_of(space_, *this);
  }

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    try {
      return evaluated(task, state);
    } catch (...) {
      task.observer.cancelled();  // a function of the user's that ends the run is no failure of the design
      throw;
    }
  }

  std::unique_ptr<EvaluatorState> restore(const std::string& bytes, const Mesh&,
                                          const std::string& source) override {
    auto memory = std::make_unique<FlowMemory>();
    try {
      memory->connectivity = std::stoull(bytes);
    } catch (const std::exception&) {
      throw Error(ErrorCode::format, source, "found no state of a design's flows");
    }
    return memory;
  }
  // What the search may take, and what is done with its last design, are no part of what a design is worth.
  std::string description() const override {
    nlohmann::ordered_json problem = nlohmann::ordered_json::parse(design_problem_json(problem_));
    problem.erase("verify");
    problem.erase("designer");
    return nlohmann::ordered_json{
        {"evaluator", "flow"}, {"problem", problem}, {"constraint_names", parts_.names()}}
        .dump();
  }

  // One point of a design, for the crew of another evaluator, whose identity_of() is to be `run`. `states`:
  // what this process has of earlier ones.
  std::optional<std::string> point_for_crew(const std::string& bytes, const std::string& run,
                                            PointStates& states, const std::function<bool()>& cancelled) {
    PostedPoint posted = decode_posted_point(bytes);
    if (posted.run != run)
      throw Error(ErrorCode::argument, "a rank",
                  "found another problem than rank 0 has, expected the same files on all hosts");
    std::unique_ptr<PointState> state = states.take(posted.point, posted.before);
    if (!state) {
      state = std::make_unique<PointState>();
      state->memory.flows.emplace_back(flow_options(posted.point, state->memory));
    } else {
      state->memory.known.note(state->design, state->from, state->memory.flows);
    }
    CrewQuestion question(cancelled);
    state->memory.observer.ask(question);
    state->memory.known.go_on_from(posted.from, state->memory.flows);
    EvaluatedPoint evaluated;
    try {
      const DesignMesh mesh(space_, posted.mesh, posted.design);
      const Shared shared{mesh,
                          posted.gradient ? std::optional<DesignDerivative>({space_, mesh}) : std::nullopt};
      evaluated.point = point_of(shared, posted.point, state->memory.flows.front(),
                                 posted.target ? &*posted.target : nullptr);
    } catch (const std::exception& problem) {
      evaluated.problem = problem.what();
    }
    if (question.told()) return std::nullopt;
    state->design = std::move(posted.design), state->from = std::move(posted.from);
    states.put(posted.point, posted.token, std::move(state));
    return encode(evaluated);
  }

 private:
  // What the points of a design have in common.
  struct Shared {
    const DesignMesh& mesh;
    std::optional<DesignDerivative> derivative;  // none: no gradients are asked for
  };
  Evaluation evaluated(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) {
    const bool is_first = !state;
    if (is_first) state = std::make_unique<FlowMemory>();
    auto& memory = static_cast<FlowMemory&>(*state);
    memory.observer.ask(task.observer);
    while (ranks_ == nullptr && memory.flows.size() < problem_.points.size())
      memory.flows.emplace_back(flow_options(memory.flows.size(), memory));
    if (is_first || task.step.changed() != 0) memory.connectivity = 2 * task.evaluation;
    if (parts_.target) aim(task, memory);
    std::vector<PointFlow> points =
        ranks_ != nullptr ? points_elsewhere(task, memory) : points_here(task, memory);
    Evaluation result{.objective = 0.0};
    for (std::size_t i = 0; i < points.size(); ++i) {
      note(points[i], i, task.gradient, result.outputs);
      const double factor = problem_.points[i].weight * parts_.sense;
      result.objective += factor * points[i].slopes[0].value;
      if (task.gradient) add(result.gradient, factor, points[i].slopes[0].by);
    }
    if (ranks_ == nullptr) memory.known.note(task.design, task.from, memory.flows);
    add_constraints(task, points, result);
    result.outputs["connectivity"] = static_cast<double>(memory.connectivity);
    return result;
  }

  std::vector<PointFlow> points_here(const EvaluationTask& task, FlowMemory& memory) const {
    memory.known.go_on_from(task.from, memory.flows);
    const DesignMesh mesh(space_, task.mesh, task.design);
    const Shared shared{mesh, task.gradient ? std::optional<DesignDerivative>({space_, mesh}) : std::nullopt};
    std::vector<PointFlow> points(problem_.points.size());
    ThreadTeam(std::min(points.size(), threads_)).run(points.size(), [&](std::size_t i) {
      points[i] = point_of(shared, i, memory.flows[i], parts_.target ? &memory.target[i] : nullptr);
    });
    return points;
  }

  // Each point is a job, which goes on from the flow of the design before where it was done.
  std::vector<PointFlow> points_elsewhere(const EvaluationTask& task, FlowMemory& memory) const {
    std::vector<PointFlow> points(problem_.points.size());
    memory.tokens.resize(points.size());
    ThreadTeam(points.size()).run(points.size(), [&](std::size_t i) {
      const PostedPoint posted{.run = run_,
                               .point = i,
                               .token = ranks_->new_token(),
                               .before = memory.tokens[i],
                               .design = {task.design.begin(), task.design.end()},
                               .from = {task.from.begin(), task.from.end()},
                               .gradient = task.gradient,
                               .target = parts_.target ? std::optional(memory.target[i]) : std::nullopt,
                               .mesh = {}};
      const std::optional<std::string> bytes =
          ranks_->result_of(i, encode(posted, task.mesh), [&] { return memory.observer.cancelled(); });
      if (!bytes) throw std::runtime_error("interrupted");
      EvaluatedPoint evaluated = decode_evaluated_point(*bytes);
      if (!evaluated.problem.empty()) throw std::runtime_error(evaluated.problem);
      memory.tokens[i] = posted.token;
      points[i] = std::move(evaluated.point);
    });
    return points;
  }

  FlowOptions flow_options(std::size_t point, FlowMemory& memory) const {
    FlowOptions options = design_flow_options(space_, problem_.points[point], &memory.observer);
    options.on_step = on_step_;
    return options;
  }

  static FlowResult flow_of(const DesignMesh& mesh, LivingFlow& living, const FlowConditions& conditions) {
    const bool is_first = living.keep().empty();
    FlowResult flow = mesh.solve(living, conditions);
    if (flow.converged() || !is_first) return flow;
    return aero::by_easier_flows(conditions, std::move(flow),
                                 [&](const FlowConditions& at) { return mesh.solve(living, at); });
  }

  // Called from several threads. living: the point's flow; target: its pressures, of inverse design.
  PointFlow point_of(const Shared& shared, std::size_t index, LivingFlow& living,
                     const StationPressures* target) const {
    PointFlow point{.flow = flow_of(shared.mesh, living, problem_.points[index].conditions), .slopes = {}};
    if (space_.half()) point.flow = whole_of(std::move(point.flow));
    if (!point.flow.converged()) throw std::runtime_error("no flow was found: " + point.flow.reason);
    if (!point.flow.lift_determined)
      throw std::runtime_error("the lift is not determined: a section has no edge that the flow leaves from");
    const FlowView view{shared.mesh.walls(), shared.mesh.frozen(), point.flow, target};
    point.of_outlets = outlet_numbers(problem_.points[index], view);
    std::vector<FlowValue> values;
    for (const std::size_t function : asked_[index]) {
      values.push_back(parts_.functions[function]->at(view));
      point.slopes[function].value = values.back().value;
    }
    if (shared.derivative) add_derivatives(shared, index, living, values, point);
    return point;
  }

  // Derivatives of the functions of a point by the design: those of coefficients and of pressures together.
  void add_derivatives(const Shared& shared, std::size_t index, LivingFlow& living,
                       std::vector<FlowValue>& values, PointFlow& point) const {
    WantedGradients wanted{
        .lift = false, .drag = false, .moment = false, .angle = false, .pressure_drag = false};
    std::vector<FlowFunctional> functionals;
    for (FlowValue& value : values) {
      wanted.lift = wanted.lift || value.by_lift != 0.0;
      wanted.drag = wanted.drag || value.by_drag != 0.0 || value.by_pressure_drag != 0.0;
      wanted.pressure_drag = wanted.pressure_drag || value.by_pressure_drag != 0.0;
      wanted.moment = wanted.moment || value.by_moment != 0.0;
      if (value.by_flow) functionals.push_back(std::move(*value.by_flow));
    }
    const FlowGradients gradients = living.gradients(functionals, wanted);
    if (gradients.interrupted) throw std::runtime_error("interrupted");
    const auto by_design = [&](bool is_wanted, const FlowGradient& gradient) {
      return is_wanted ? shared.derivative->vjp(gradient.points) : std::vector<double>();
    };
    const std::vector<double> lift = by_design(wanted.lift, gradients.cl),
                              moment = by_design(wanted.moment, gradients.cm),
                              of_pressure = by_design(wanted.pressure_drag, gradients.cd_pressure);
    std::vector<double> drag = by_design(wanted.drag, gradients.cd);
    if (space_.half())
      for (double& x : drag) x *= 2.0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const FlowValue& value = values[i];
      std::vector<double> by(space_.start().size(), 0.0);
      if (value.by_drag != 0.0) add(by, value.by_drag, drag);
      if (value.by_lift != 0.0) add(by, value.by_lift, lift);
      if (value.by_moment != 0.0) add(by, value.by_moment, moment);
      if (value.by_pressure_drag != 0.0) add(by, value.by_pressure_drag, of_pressure);
      if (value.by_flow) add(by, 1.0, by_design(true, gradients.functions.at(next++)));
      point.slopes[asked_[index][i]].by = std::move(by);
    }
    point.gradient_seconds = gradients.seconds;
  }

  // Values at the stations of the section, in their order, by parameter.
  static StationPressures at_stations(const FrozenMesh& mesh, const std::vector<double>& values) {
    StationPressures result;
    for (std::size_t p = 0; p < values.size(); ++p)
      if (mesh.curve[p] == 0 && mesh.steiner[p] == 0) result[mesh.parameter[p]] = values[p];
    return result;
  }

  // The target's pressures on the connectivity that the design has, as soon as the mesh can follow to it:
  // they have the same errors as the design's then, and the objective is 0 at the target. That shifts the
  // objective, as a change of connectivity does.
  void aim(const EvaluationTask& task, FlowMemory& memory) const {
    const bool is_aimed = memory.aimed_at == memory.connectivity;
    if (is_aimed && memory.is_like) return;
    Mesh mesh = task.mesh;
    const Domain& walls = *parts_.target;
    const RemodelResult step =
        remodel(mesh, space_.layers() == nullptr ? walls : space_.layers()->outside(walls),
                {.strategy = info_of(design_strategy).step});
    const bool is_like = step.born() == 0 && step.gone() == 0;
    if (is_aimed && !is_like) return;
    if (is_aimed) ++memory.connectivity;
    memory.target.clear();
    const DesignMesh target(space_, mesh, walls);
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      if (memory.target_flows.size() == i) memory.target_flows.emplace_back(flow_options(i, memory));
      const FlowResult flow = flow_of(target, memory.target_flows[i], problem_.points[i].conditions);
      if (!flow.converged()) throw std::runtime_error("no flow was found around the target: " + flow.reason);
      memory.target.push_back(at_stations(target.frozen(), pressure_coefficients(flow)));
    }
    memory.aimed_at = memory.connectivity;
    memory.is_like = is_like;
  }

  static void note(const PointFlow& point, std::size_t index, bool with_gradients,
                   std::map<std::string, double>& outputs) {
    const FlowResult& flow = point.flow;
    const auto of_point = [&](const std::string& name) -> double& {
      return outputs[output_name(name, index)];
    };
    of_point("cl") = flow.cl, of_point("cd") = flow.cd, of_point("cm") = flow.cm;
    of_point("alpha_deg") = flow.alpha_deg;
    if (flow.friction) {
      of_point("cd_pressure") = flow.friction->cd_pressure;
      of_point("cd_friction") = flow.friction->cd_friction;
    }
    for (const auto& [name, value] : point.of_outlets) of_point(name) = value;
    outputs["flow_seconds"] += flow.seconds;
    outputs["factorisations"] += flow.factorisations;
    if (with_gradients) outputs["gradient_seconds"] += point.gradient_seconds;
  }

  void add_constraints(const EvaluationTask& task, std::vector<PointFlow>& points, Evaluation& result) const {
    const auto add_one = [&](double value, std::vector<double> by) {
      result.constraints.push_back(value);
      if (task.gradient) result.constraint_gradients.push_back(std::move(by));
    };
    const Domain walls = space_.walls(task.design);
    const DesignView view{space_, task.design, walls};
    for (const ResolvedProblem::DomainLimit& limit : parts_.domain)
      for (DesignValue& value : limit.constraint->at(view)) add_one(value.value, std::move(value.by_design));
    for (const ResolvedProblem::FlowLimit& limit : parts_.flow) {
      const Slope& slope = points[limit.point].slopes[limit.function];
      std::vector<double> row = slope.by;
      for (double& x : row) x *= limit.factor;
      add_one(limit.factor * (slope.value - limit.limit), std::move(row));
    }
  }

  DesignProblem problem_;
  ResolvedProblem parts_;
  const FlowSpace& space_;
  std::size_t threads_;
  PostedJobs* ranks_;
  std::function<void(const FlowProgress&)> on_step_;
  std::string run_;                              // PostedPoint::run, where ranks find flows
  std::vector<std::vector<std::size_t>> asked_;  // of each point: functions
};

}  // namespace

std::unique_ptr<Evaluator> flow_evaluator(const DesignProblem& problem, const FlowSpace& space,
                                          std::size_t threads, PostedJobs* ranks,
                                          std::function<void(const FlowProgress&)> on_step) {
  return std::make_unique<FlowEvaluator>(problem, space, threads, ranks, std::move(on_step));
}

CrewWork flow_points_work(const DesignProblem& problem) {
  struct Parts {
    explicit Parts(const DesignProblem& of)
        : space(design_space(of)), evaluator(of, *space, 1, nullptr, {}) {}
    std::unique_ptr<FlowSpace> space;
    FlowEvaluator evaluator;
    PointStates states;
  };
  const auto parts = std::make_shared<Parts>(problem);
  return [parts, run = identity_of(*parts->space, parts->evaluator)](const std::string& bytes,
                                                                     const std::function<bool()>& cancelled) {
    return parts->evaluator.point_for_crew(bytes, run, parts->states, cancelled);
  };
}

}  // namespace remodel
