// The evaluator of `remodel design`: the flows of all points on the living mesh, and their gradients.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stdexcept>

#include "base/threads.h"
#include "design_memory.h"
#include "design_problem.h"
#include "gap.h"
#include "remodel/mesh_derivative.h"
#include "remodel/remodel.h"

namespace remodel::app {

namespace {

// A value and its derivatives by the coefficients of the domain, of one flow.
struct Slope {
  double value = 0.0;
  std::vector<double> by;
};

// By their names: "cl", "cd", "cm", "inverse", and suction peaks by suction_name().
using Slopes = std::map<std::string, Slope>;

std::string suction_name(const std::optional<std::size_t>& section) {
  return section ? "suction " + std::to_string(*section) : "suction";
}

void add(Slope& to, double factor, const Slope& from) {
  to.value += factor * from.value;
  to.by.resize(from.by.size(), 0.0);
  for (std::size_t i = 0; i < from.by.size(); ++i) to.by[i] += factor * from.by[i];
}

class FlowEvaluator final : public Evaluator {
 public:
  FlowEvaluator(const DesignProblemFile& problem, const FlowSpace& space, std::size_t threads)
      : problem_(problem), space_(space), threads_(threads) {
    if (problem.target)
      target_ = SectionSpace(problem.start, problem.section_options())
                    .domain_of(*problem.target, problem.domain.points);
  }

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    const bool is_first = !state;
    if (is_first) state = std::make_unique<FlowMemory>();
    auto& memory = static_cast<FlowMemory&>(*state);
    memory.observer.ask(task.observer);
    while (memory.flows.size() < problem_.points.size())
      memory.flows.emplace_back(flow_options(space_.half(), &memory.observer));
    if (is_first || task.step.changed() != 0) memory.connectivity = 2 * task.evaluation;
    if (problem_.target) aim(task, memory);
    memory.known.go_on_from(task.from, memory.flows);
    const Shared shared = shared_of(task);
    std::vector<PointFlow> points(problem_.points.size());
    ThreadTeam(std::min(points.size(), threads_)).run(points.size(), [&](std::size_t i) {
      points[i] = point_of(shared, i, memory);
    });
    Evaluation result;
    Slope objective;
    std::vector<Slopes> coefficients;
    for (std::size_t i = 0; i < points.size(); ++i) {
      note(points[i], i, task.gradient, result.outputs);
      coefficients.push_back(std::move(points[i].slopes));
      add(objective, problem_.points[i].weight, objective_of(coefficients.back()));
    }
    memory.known.note(task.design, task.from, memory.flows);
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
    return Json{
        {"evaluator", "flow"}, {"problem", problem}, {"constraint_names", problem_.constraint_names()}}
        .dump();
  }

 private:
  // What the points of a design have in common.
  struct Shared {
    const EvaluationTask& task;
    MeshDerivative derivative;
    FrozenMesh frozen;  // where functions of pressures are asked for
  };
  // What came of a point.
  struct PointFlow {
    FlowResult flow;
    Slopes slopes;
    double gradient_seconds = 0.0;
  };

  Shared shared_of(const EvaluationTask& task) const {
    const bool of_pressures =
        problem_.target.has_value() || std::any_of(problem_.flow.begin(), problem_.flow.end(),
                                                   [](const auto& c) { return c.of == "suction"; });
    return {task, MeshDerivative(task.mesh), of_pressures ? task.mesh.freeze() : FrozenMesh{}};
  }

  // Called from several threads: of the memory it changes this point's flow alone.
  PointFlow point_of(const Shared& shared, std::size_t index, FlowMemory& memory) const {
    PointFlow point{.flow = memory.flows[index].solve(shared.task.mesh, problem_.points[index].conditions),
                    .slopes = {}};
    if (space_.half()) point.flow = whole(std::move(point.flow));
    if (!point.flow.converged()) throw std::runtime_error("no flow was found: " + point.flow.reason);
    add_slopes(shared, index, memory, point);
    return point;
  }

  // What objective and constraints may ask for of a point's flow.
  void add_slopes(const Shared& shared, std::size_t index, FlowMemory& memory, PointFlow& point) const {
    const FlowResult& flow = point.flow;
    Slopes& of = point.slopes;
    of = {{"cl", {flow.cl, {}}}, {"cd", {flow.cd, {}}}, {"cm", {flow.cm, {}}}};
    std::vector<std::string> names;
    std::vector<FlowFunctional> functions;
    if (problem_.target) {
      names.push_back("inverse");
      functions.push_back(mismatch(shared.frozen, flow, memory.target[index], of["inverse"].value));
    }
    for (const FlowConstraint& constraint : problem_.flow) {
      const std::string name = suction_name(constraint.section);
      if (constraint.of != "suction" || constraint.point != index || of.contains(name)) continue;
      names.push_back(name);
      functions.push_back(
          suction_peak(shared.task.mesh, shared.frozen, flow, constraint.section, of[name].value));
    }
    if (!shared.task.gradient) return;
    const FlowGradients gradients = memory.flows[index].gradients(functions, wanted_of(index));
    if (gradients.interrupted) throw std::runtime_error("interrupted");
    for (const auto& [name, gradient] :
         {std::pair{"cl", &gradients.cl}, {"cd", &gradients.cd}, {"cm", &gradients.cm}})
      if (!gradient->points.empty()) of[name].by = by_design(shared.derivative, *gradient);
    for (std::size_t i = 0; i < names.size(); ++i)
      of[names[i]].by = by_design(shared.derivative, gradients.functions.at(i));
    if (space_.half())
      for (double& x : of["cd"].by) x *= 2.0;
    point.gradient_seconds = gradients.seconds;
  }

  // The derivatives that the objective and the constraints of a point take.
  WantedGradients wanted_of(std::size_t point) const {
    const auto takes = [&](const char* coefficient, std::initializer_list<const char*> objectives) {
      return std::any_of(objectives.begin(), objectives.end(),
                         [&](const char* name) { return problem_.objective == name; }) ||
             std::any_of(problem_.flow.begin(), problem_.flow.end(), [&](const FlowConstraint& constraint) {
               return constraint.point == point && constraint.of == coefficient;
             });
    };
    return {.lift = takes("cl", {"lift", "lift_over_drag"}),
            .drag = takes("cd", {"drag", "lift_over_drag"}),
            .moment = takes("cm", {"moment"}),
            .angle = false};
  }

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
    const RemodelResult step = remodel(mesh, *target_, {.strategy = Strategy::morph});
    const bool is_like = step.born() == 0 && step.gone() == 0;
    if (is_aimed && !is_like) return;
    if (is_aimed) ++memory.connectivity;
    memory.target.clear();
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      if (memory.target_flows.size() == i)
        memory.target_flows.emplace_back(flow_options(space_.half(), &memory.observer));
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

  Slope objective_of(Slopes& of) const {
    if (problem_.objective == "drag") return of["cd"];
    if (problem_.objective == "inverse") return of["inverse"];
    Slope result;
    if (problem_.objective == "moment" || problem_.objective == "lift") {
      add(result, -1.0, of[problem_.objective == "lift" ? "cl" : "cm"]);
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

  static void note(const PointFlow& point, std::size_t index, bool with_gradients,
                   std::map<std::string, double>& outputs) {
    const FlowResult& flow = point.flow;
    const std::string suffix = index == 0 ? "" : "_" + std::to_string(index + 1);
    outputs["cl" + suffix] = flow.cl, outputs["cd" + suffix] = flow.cd, outputs["cm" + suffix] = flow.cm;
    outputs["alpha_deg" + suffix] = flow.alpha_deg;
    outputs["flow_seconds"] += flow.seconds;
    outputs["factorisations"] += flow.factorisations;
    if (with_gradients) outputs["gradient_seconds"] += point.gradient_seconds;
  }

  void add_constraints(const EvaluationTask& task, std::vector<Slopes>& of, Evaluation& result) const {
    const auto add_one = [&](double value, std::vector<double> by) {
      result.constraints.push_back(value);
      if (task.gradient) result.constraint_gradients.push_back(std::move(by));
    };
    for (const SectionConstraint& constraint : problem_.section) {
      const CstAirfoil section = space_.section(task.design, constraint.section);
      const std::size_t n = section.upper.size();
      double value = constraint.bound;
      std::vector<double> row = constraint.row;
      for (std::size_t i = 0; i < row.size(); ++i) {
        value -= row[i] * (i < n ? section.upper[i] : section.lower[i - n]);
        row[i] = -row[i];
      }
      add_one(value, space_.gradient_of_section(constraint.section, row));
    }
    for (const GapConstraint& constraint : problem_.gaps) {
      Gap gap = gap_between(task.mesh.domain(), constraint.section, constraint.other);
      for (double& x : gap.by_numbers) x = -x;
      add_one(constraint.at_least - gap.distance, space_.gradient_of_domain(gap.by_numbers));
    }
    for (const FlowConstraint& constraint : problem_.flow) {
      const bool is_suction = constraint.of == "suction";
      const Slope& slope =
          of[constraint.point][is_suction ? suction_name(constraint.section) : constraint.of];
      const double factor = constraint.factor();
      std::vector<double> row = slope.by;
      for (double& x : row) x *= factor;
      add_one(factor * (slope.value - constraint.value), std::move(row));
    }
  }

  const DesignProblemFile& problem_;
  const FlowSpace& space_;
  std::size_t threads_;
  std::optional<Domain> target_;  // of inverse design
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

FlowFunctional suction_peak(const Mesh& mesh, const FrozenMesh& frozen, const FlowResult& flow,
                            std::optional<std::size_t> loop, double& value) {
  constexpr double sharpness = 10.0;
  FlowFunctional function{.pressure = std::vector<double>(frozen.points.size(), 0.0),
                          .points = std::vector<Point>(frozen.points.size())};
  const std::vector<double> cp = pressure_coefficients(flow);
  const auto is_asked_for = [&](std::size_t p) {
    if (frozen.curve[p] < 0 || frozen.steiner[p] != 0) return false;
    const auto curve = static_cast<std::size_t>(frozen.curve[p]);
    if (loop) return mesh.domain().loop_of(curve) == *loop;
    const std::string& name = mesh.domain().curve(curve).name;
    return name != "farfield" && name != "symmetry";
  };
  double most = -std::numeric_limits<double>::infinity(), sum = 0.0;
  for (std::size_t p = 0; p < cp.size(); ++p)
    if (is_asked_for(p)) most = std::max(most, -cp[p]);
  for (std::size_t p = 0; p < cp.size(); ++p)
    if (is_asked_for(p)) sum += function.pressure[p] = std::exp(sharpness * (-cp[p] - most));
  for (double& share : function.pressure) share *= -1.0 / (sum * 0.5 * flow.mach * flow.mach);
  value = most + std::log(sum) / sharpness;
  return function;
}

double excess_of(const FlowConstraint& constraint, const Mesh& mesh, const FlowResult& flow) {
  double value = constraint.of == "cl" ? flow.cl : constraint.of == "cd" ? flow.cd : flow.cm;
  if (constraint.of == "suction") suction_peak(mesh, mesh.freeze(), flow, constraint.section, value);
  return constraint.factor() * (value - constraint.value);
}

FlowResult solve_section(const Mesh& mesh, const FlowConditions& conditions, bool half,
                         StepObserver* observer) {
  FlowResult flow = solve_flow(mesh, conditions, flow_options(half, observer));
  return half ? whole(std::move(flow)) : flow;
}

std::unique_ptr<Evaluator> make_flow_evaluator(const DesignProblemFile& problem, const FlowSpace& space,
                                               std::size_t threads) {
  return std::make_unique<FlowEvaluator>(problem, space, threads);
}

}  // namespace remodel::app
