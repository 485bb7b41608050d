// The evaluator of `remodel design`: the flows of all points on the living mesh, and their gradients.

#include <cmath>
#include <stdexcept>

#include "design_problem.h"
#include "remodel/generate.h"
#include "remodel/mesh_derivative.h"

namespace remodel::app {

namespace {

struct FlowMemory final : EvaluatorState {
  std::vector<LivingFlow> flows;
  std::uint64_t connectivity = 0;  // how often it has changed
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
      : problem_(problem), space_(space) {
    if (!problem.target) return;
    const Mesh mesh =
        generate(airfoil_domain(*problem.target, problem.domain), {.gradation = problem.gradation}).mesh;
    for (const DesignPoint& point : problem.points) {
      const FlowResult flow = solve_flow(mesh.freeze(), point.conditions, {}, "target");
      if (!flow.converged())
        throw Error(ErrorCode::argument, "target", "no flow was found around it: " + flow.reason);
      target_.push_back(at_stations(mesh.freeze(), pressure_coefficients(flow)));
    }
  }

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    if (!state) {
      auto fresh = std::make_unique<FlowMemory>();
      state = std::move(fresh);
    }
    auto& memory = static_cast<FlowMemory&>(*state);
    while (memory.flows.size() < problem_.points.size())
      memory.flows.emplace_back(FlowOptions{.observer = &task.observer});
    if (!task.step.full_adjustment) ++memory.connectivity;
    Evaluation result;
    const MeshDerivative derivative(task.mesh);
    Slope objective;
    std::vector<std::map<std::string, Slope>> coefficients;
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      const DesignPoint& point = problem_.points[i];
      const FlowResult flow = memory.flows[i].solve(task.mesh, point.conditions);
      if (!flow.converged()) throw std::runtime_error("no flow was found: " + flow.reason);
      std::map<std::string, Slope> of{{"cl", {flow.cl, {}}}, {"cd", {flow.cd, {}}}, {"cm", {flow.cm, {}}}};
      std::optional<FlowFunctional> inverse;
      if (problem_.target) inverse = mismatch(task.mesh.freeze(), flow, i, of["inverse"].value);
      if (task.gradient) {
        const FlowGradients gradients =
            memory.flows[i].gradients(inverse ? std::vector{*inverse} : std::vector<FlowFunctional>{});
        of["cl"].by = derivative.vjp(gradients.cl.points);
        of["cd"].by = derivative.vjp(gradients.cd.points);
        of["cm"].by = derivative.vjp(gradients.cm.points);
        if (inverse) of["inverse"].by = derivative.vjp(gradients.functions.at(0).points);
        result.outputs["gradient_seconds"] += gradients.seconds;
      }
      add(objective, point.weight, objective_of(of));
      note(flow, i, result.outputs);
      coefficients.push_back(std::move(of));
    }
    result.objective = objective.value;
    if (task.gradient) result.gradient = space_.gradient(objective.by);
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
  std::string description() const override { return Json{{"evaluator", "flow"}}.dump(); }

 private:
  // Values at the stations of the section, in their order, by parameter.
  static std::map<double, double> at_stations(const FrozenMesh& mesh, const std::vector<double>& values) {
    std::map<double, double> result;
    for (std::size_t p = 0; p < values.size(); ++p)
      if (mesh.curve[p] == 0 && mesh.steiner[p] == 0) result[mesh.parameter[p]] = values[p];
    return result;
  }

  // Half the mean square difference of pressure coefficients at stations.
  FlowFunctional mismatch(const FrozenMesh& mesh, const FlowResult& flow, std::size_t point,
                          double& value) const {
    FlowFunctional function{.pressure = std::vector<double>(mesh.points.size(), 0.0),
                            .points = std::vector<Point>(mesh.points.size())};
    const std::vector<double> cp = pressure_coefficients(flow);
    const std::map<double, double>& target = target_[point];
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
      result.constraint_gradients.push_back(space_.gradient(row));
    }
  }

  const DesignProblemFile& problem_;
  const SectionSpace& space_;
  std::vector<std::map<double, double>> target_;
};

}  // namespace

std::unique_ptr<Evaluator> make_flow_evaluator(const DesignProblemFile& problem, const SectionSpace& space) {
  return std::make_unique<FlowEvaluator>(problem, space);
}

}  // namespace remodel::app
