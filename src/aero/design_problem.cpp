#include "remodel/design_problem.h"

#include <nlohmann/json.hpp>

#include "aero/design_mesh.h"
#include "aero/first_design.h"
#include "aero/problem_openings.h"
#include "aero/resolved_problem.h"
#include "remodel/sqp.h"

namespace remodel {
namespace {

using ProblemJson = nlohmann::ordered_json;

ProblemJson points_json(const DesignProblem& problem) {
  ProblemJson points = ProblemJson::array();
  for (const DesignPoint& point : problem.points) {
    const FlowConditions& conditions = point.conditions;
    points.push_back({{"mach", conditions.mach}, {"alpha_deg", conditions.alpha_deg}});
    if (conditions.cl) points.back()["cl"] = *conditions.cl;
    points.back()["weight"] = point.weight;
    write_openings(point, points.back());
    if (point.model == FlowModel::euler) continue;
    points.back()["model"] = name_of(point.model);
    points.back()["reynolds"] = conditions.reynolds;
    if (conditions.transition) points.back()["transition"] = *conditions.transition;
  }
  return points;
}

ProblemJson constraint_json(const DesignConstraint& constraint) {
  ProblemJson json = {{"kind", constraint.kind.empty() ? "own" : constraint.kind}};
  const auto add = [&](const char* key, const auto& value) {
    if (value) json[key] = *value;
  };
  add("at_least", constraint.at_least), add("at_most", constraint.at_most);
  add("of_start", constraint.of_start), add("point", constraint.point), add("x", constraint.x);
  if (constraint.airfoil) json["airfoil"] = ProblemJson::parse(airfoil_to_json(*constraint.airfoil));
  add("element", constraint.element), add("between", constraint.between);
  if (!constraint.name.empty()) json["name"] = constraint.name;
  return json;
}

std::unique_ptr<Designer> make_cmaes(const DesignProblem& problem, const FlowSpace& space) {
  return std::make_unique<CmaesDesigner>(first_design_of(problem, space, ProblemPlace("design problem")),
                                         CmaesOptions{.sigma = problem.sigma, .seed = problem.seed});
}

std::unique_ptr<Designer> make_sqp(const DesignProblem& problem, const FlowSpace& space) {
  DesignBounds bounds = space.bounds(problem.bounds);
  return std::make_unique<SqpDesigner>(first_design_of(problem, space, ProblemPlace("design problem")),
                                       SqpOptions{.trust = problem.trust,
                                                  .least_promise = problem.least_promise,
                                                  .constraint_tolerance = problem.constraint_tolerance,
                                                  .low = std::move(bounds.low),
                                                  .high = std::move(bounds.high),
                                                  .metric = space.metric()});
}

struct DesignerKind {
  const char* name;
  std::unique_ptr<Designer> (*make)(const DesignProblem& problem, const FlowSpace& space);
};
constexpr DesignerKind designer_kinds[] = {{"sqp", make_sqp}, {"cmaes", make_cmaes}};

}  // namespace

std::vector<std::string> designer_names() {
  std::vector<std::string> names;
  for (const DesignerKind& kind : designer_kinds) names.emplace_back(kind.name);
  return names;
}

std::unique_ptr<Designer> make_designer(const DesignProblem& problem, const FlowSpace& space) {
  for (const DesignerKind& kind : designer_kinds)
    if (problem.designer == kind.name) return kind.make(problem, space);
  ProblemPlace("designer").require_word(problem.designer, "name", designer_names());
  return nullptr;
}

void validate(const DesignProblem& problem, const std::string& source) {
  resolved(problem, source);
}

DesignProblem with_first_design(DesignProblem problem, const std::string& source) {
  std::vector<double> first = resolved(problem, source).first_design;
  if (problem.start) problem.first_design = std::move(first), problem.start.reset();
  return problem;
}

std::unique_ptr<FlowSpace> design_space(const DesignProblem& problem) {
  return std::move(resolved(problem, "design problem").space);
}

std::vector<std::string> constraint_names(const DesignProblem& problem) {
  return resolved(problem, "design problem").names();
}

std::string design_problem_json(const DesignProblem& problem) {
  if (!problem.text.empty()) return problem.text;
  // What the space and the designer are says the run's settings beside it.
  ProblemJson json = {{"symmetric", problem.symmetric},
                      {"flow", points_json(problem)},
                      {"objective", problem.objective},
                      {"constraints", ProblemJson::array()},
                      {"constraint_tolerance", problem.constraint_tolerance}};
  if (problem.target) json["target"] = ProblemJson::parse(airfoil_to_json(*problem.target));
  for (const DesignConstraint& constraint : problem.constraints)
    json["constraints"].push_back(constraint_json(constraint));
  return json.dump();
}

FlowOptions design_flow_options(const FlowSpace& space, const DesignPoint& point, StepObserver* observer) {
  return {.vortex = !space.half(),
          .observer = observer,
          .inlets = point.inlets,
          .outlets = point.outlets,
          .symmetry = point.symmetry,
          .model = point.model};
}

FlowResult whole_of(FlowResult half) {
  half.cd *= 2.0;
  half.cl = half.cm = 0.0;
  return half;
}

FlowResult solve_design_flow(const FlowSpace& space, const Mesh& mesh, std::span<const double> design,
                             const DesignPoint& point, StepObserver* observer) {
  const FlowOptions options = design_flow_options(space, point, observer);
  FlowResult flow = space.layers() != nullptr
                        ? solve_flow(DesignMesh(space, mesh, design).frozen(), point.conditions, options)
                        : solve_flow(mesh, point.conditions, options);
  return space.half() ? whole_of(std::move(flow)) : flow;
}

}  // namespace remodel
