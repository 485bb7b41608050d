// The evaluator of `remodel design`: the flows of all points on the living mesh, and their gradients.

#include <cmath>
#include <optional>
#include <stdexcept>

#include "design_problem.h"
#include "remodel/mesh_derivative.h"
#include "remodel/remodel.h"

namespace remodel::app {

namespace {

struct FlowMemory final : EvaluatorState {
  std::vector<LivingFlow> flows;
  std::uint64_t connectivity = 0;  // how often it has changed
  // Of inverse design: the target's pressures at stations, on a copy of the mesh that followed to it.
  std::vector<LivingFlow> target_flows;
  std::vector<std::map<double, double>> target;
  std::optional<std::uint64_t> aimed_at = {};  // the connectivity that the copy was made of
  bool is_like = false;                        // and has itself
  std::string bytes() const override { return std::to_string(connectivity); }
};

// A value and its derivatives by the coefficients of the domain, of one flow.
struct Slope {
  double value = 0.0;
  std::vector<double> by;
};

void add(Slope& to, double factor, const Slope& from) {
  to.value += factor * from.value;
  to.by.resize(from.by.size(), 0.0);
  for (std::size_t i = 0; i < from.by.size(); ++i) to.by[i] += factor * from.by[i];
}

class FlowEvaluator final : public Evaluator {
 public:
  FlowEvaluator(const DesignProblemFile& problem, const SectionSpace& space)
      : problem_(problem), space_(space) {}

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    if (!state) {
      auto fresh = std::make_unique<FlowMemory>();
      state = std::move(fresh);
    }
    auto& memory = static_cast<FlowMemory&>(*state);
    while (memory.flows.size() < problem_.points.size())
      memory.flows.emplace_back(flow_options(space_.half(), &task.observer));
    if (!task.step.full_adjustment) ++memory.connectivity;
    if (problem_.target) aim(task, memory);
    Evaluation result;
    const MeshDerivative derivative(task.mesh);
    Slope objective;
    std::vector<std::map<std::string, Slope>> coefficients;
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      const DesignPoint& point = problem_.points[i];
      FlowResult flow = memory.flows[i].solve(task.mesh, point.conditions);
      if (space_.half()) flow = whole(std::move(flow));
      if (!flow.converged()) throw std::runtime_error("no flow was found: " + flow.reason);
      std::map<std::string, Slope> of{{"cl", {flow.cl, {}}}, {"cd", {flow.cd, {}}}, {"cm", {flow.cm, {}}}};
      std::optional<FlowFunctional> inverse;
      if (problem_.target)
        inverse = mismatch(task.mesh.freeze(), flow, memory.target[i], of["inverse"].value);
      if (task.gradient) {
        const FlowGradients gradients =
            memory.flows[i].gradients(inverse ? std::vector{*inverse} : std::vector<FlowFunctional>{});
        of["cl"].by = by_design(derivative, gradients.cl);
        of["cd"].by = by_design(derivative, gradients.cd);
        of["cm"].by = by_design(derivative, gradients.cm);
        if (inverse) of["inverse"].by = by_design(derivative, gradients.functions.at(0));
        if (space_.half())
          for (double& x : of["cd"].by) x *= 2.0;
        result.outputs["gradient_seconds"] += gradients.seconds;
      }
      add(objective, point.weight, objective_of(of));
      note(flow, i, result.outputs);
      coefficients.push_back(std::move(of));
    }
    result.objective = objective.value;
    if (task.gradient) result.gradient = objective.by;
    add_constraints(task, coefficients, result);
    result.outputs["connectivity"] = static_cast<double>(memory.connectivity);
    return result;
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
    Json problem = Json::parse(problem_.text);
    problem.erase("verify");
    problem.erase("designer");
    return Json{{"evaluator", "flow"}, {"problem", problem}}.dump();
  }

 private:
  // By the design, of derivatives by points.
  std::vector<double> by_design(const MeshDerivative& mesh, const FlowGradient& gradient) const {
    return space_.gradient_of_domain(mesh.vjp(gradient.points));
  }

  // Values at the stations of the section, in their order, by parameter.
  static std::map<double, double> at_stations(const FrozenMesh& mesh, const std::vector<double>& values) {
    std::map<double, double> result;
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
    const bool is_like =
        remodel(mesh, space_.domain_of(*problem_.target, problem_.domain.points)).full_adjustment;
    if (is_aimed && !is_like) return;
    if (is_aimed) ++memory.connectivity;
    memory.target.clear();
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      if (memory.target_flows.size() == i)
        memory.target_flows.emplace_back(flow_options(space_.half(), &task.observer));
      const FlowResult flow = memory.target_flows[i].solve(mesh, problem_.points[i].conditions);
      if (!flow.converged()) throw std::runtime_error("no flow was found around the target: " + flow.reason);
      memory.target.push_back(at_stations(mesh.freeze(), pressure_coefficients(flow)));
    }
    memory.aimed_at = memory.connectivity;
    memory.is_like = is_like;
  }

  // Half the mean square difference of pressure coefficients at stations.
  static FlowFunctional mismatch(const FrozenMesh& mesh, const FlowResult& flow,
                                 const std::map<double, double>& target, double& value) {
    FlowFunctional function{.pressure = std::vector<double>(mesh.points.size(), 0.0),
                            .points = std::vector<Point>(mesh.points.size())};
    const std::vector<double> cp = pressure_coefficients(flow);
    const double share = 1.0 / static_cast<double>(target.size());
    for (std::size_t p = 0; p < cp.size(); ++p) {
      if (mesh.curve[p] != 0 || mesh.steiner[p] != 0) continue;
      const double difference = cp[p] - target.at(mesh.parameter[p]);
      value += 0.5 * share * difference * difference;
      function.pressure[p] = share * difference / (0.5 * flow.mach * flow.mach);
    }
    return function;
  }

  Slope objective_of(std::map<std::string, Slope>& of) const {
    if (problem_.objective == "drag") return of["cd"];
    if (problem_.objective == "inverse") return of["inverse"];
    Slope result;
    if (problem_.objective == "moment") {
      add(result, -1.0, of["cm"]);
      return result;
    }
    // Drag over lift is made small: it is smooth where drag is none.
    const double cl = of["cl"].value, cd = of["cd"].value;
    if (!(cl > 0.0)) throw std::runtime_error("the lift is not positive");
    add(result, 1.0 / cl, of["cd"]);
    result.value = 0.0;
    add(result, -cd / (cl * cl), of["cl"]);
    result.value = cd / cl;
    return result;
  }

  static void note(const FlowResult& flow, std::size_t point, std::map<std::string, double>& outputs) {
    const std::string suffix = point == 0 ? "" : "_" + std::to_string(point + 1);
    outputs["cl" + suffix] = flow.cl, outputs["cd" + suffix] = flow.cd, outputs["cm" + suffix] = flow.cm;
    outputs["alpha_deg" + suffix] = flow.alpha_deg;
    outputs["flow_seconds"] += flow.seconds;
    outputs["factorisations"] += flow.factorisations;
  }

  void add_constraints(const EvaluationTask& task, std::vector<std::map<std::string, Slope>>& of,
                       Evaluation& result) const {
    const std::vector<double> a = space_.coefficients(task.design);
    for (const SectionConstraint& constraint : problem_.section) {
      double value = constraint.bound;
      std::vector<double> row = constraint.row;
      for (std::size_t i = 0; i < row.size(); ++i) value -= row[i] * a[i], row[i] = -row[i];
      result.constraints.push_back(value);
      if (task.gradient) result.constraint_gradients.push_back(space_.gradient(row));
    }
    for (const FlowConstraint& constraint : problem_.flow) {
      const Slope& slope = of[constraint.point][constraint.of];
      result.constraints.push_back(constraint.sign * (slope.value - constraint.value));
      if (!task.gradient) continue;
      std::vector<double> row = slope.by;
      for (double& x : row) x *= constraint.sign;
      result.constraint_gradients.push_back(std::move(row));
    }
  }

  const DesignProblemFile& problem_;
  const SectionSpace& space_;
};

}  // namespace

FlowOptions flow_options(bool half, StepObserver* observer) {
  return {.vortex = !half, .observer = observer};
}

FlowResult whole(FlowResult half) {
  half.cd *= 2.0;
  half.cl = half.cm = 0.0;
  return half;
}

FlowResult solve_section(const Mesh& mesh, const FlowConditions& conditions, bool half) {
  FlowResult flow = solve_flow(mesh, conditions, flow_options(half));
  return half ? whole(std::move(flow)) : flow;
}

std::unique_ptr<Evaluator> make_flow_evaluator(const DesignProblemFile& problem, const SectionSpace& space) {
  return std::make_unique<FlowEvaluator>(problem, space);
}

}  // namespace remodel::app
