#include "remodel/design_problem.h"

#include <algorithm>
#include <cmath>

#include "aero/deformed_space.h"
#include "aero/problem_elements.h"
#include "aero/problem_json.h"
#include "aero/problem_keys.h"
#include "aero/problem_openings.h"
#include "aero/problem_space.h"
#include "aero/resolved_problem.h"
#include "remodel/flow_layer.h"

namespace remodel {

namespace {

// What a problem may have at most of each: more would not end, and is a mistake of whoever wrote the file.
constexpr std::size_t most_points = 1000, most_constraints = 1000, most_verified = 100, most_meshes = 10;

DesignPoint point_of(const Json& entry, const std::string& where) {
  const Keys keys(entry, where,
                  {"mach", "alpha_deg", "cl", "weight", "model", "reynolds", "transition", "inlets",
                   "outlets", "symmetry"});
  DesignPoint point{.conditions = {.mach = keys.get<double>("mach"),
                                   .alpha_deg = keys.get<double>("alpha_deg", 0.0),
                                   .cl = keys.find<double>("cl"),
                                   .reynolds = keys.get<double>("reynolds", 0.0)},
                    .weight = keys.get<double>("weight", 1.0),
                    .model = model_named(keys)};
  point.conditions.transition = transition_of(keys);
  require_reynolds(keys, point.model);
  read_openings(entry, where, point);
  return point;
}

// One number, or several from coarse to fine.
void read_points_of_meshes(const Keys& mesh, const Json& given, bool may_be_odd, DesignProblem& problem) {
  std::vector<int> points;
  for (const Json& entry : given.is_array() ? mesh.list("points", most_meshes) : Json::array({given})) {
    points.push_back(mesh.whole_number<int>(entry, "points", 8, 100000));
    if (points.back() % 2 != 0 && !may_be_odd)
      mesh.fail("found " + std::to_string(points.back()) + " as 'points', expected an even number");
  }
  if (points.empty()) mesh.fail("found no number in 'points', expected one or more");
  problem.domain.points = points.back();
  points.pop_back();
  problem.coarse_points = std::move(points);
}

std::optional<WakeLine> wake_given(const Keys& mesh) {
  const auto length = mesh.find<double>("wake"), degrees = mesh.find<double>("wake_angle_deg");
  if (!length && degrees) mesh.fail("found 'wake_angle_deg' without 'wake', expected both");
  if (!length) return std::nullopt;
  if (!(*length > 0.0 && *length <= 1e3))
    mesh.fail("found " + shown(*length) + " as 'wake', expected more than 0 and at most 1000 chords");
  if (degrees && !(std::abs(*degrees) <= 90.0))
    mesh.fail("found " + shown(*degrees) + " as 'wake_angle_deg', expected -90 to 90");
  return wake_at(*length, degrees.value_or(0.0));
}

void read_mesh_options(const Json& json, const std::string& file, DesignProblem& problem) {
  const Json object = object_of(json, "mesh");
  const Keys mesh(object, file + ", mesh",
                  {"points", "gradation", "farfield_radius", "layers", "wake", "wake_angle_deg"});
  const bool has_friction = problem.points.front().model != FlowModel::euler;
  problem.domain.points = has_friction ? usual_points_with_friction : 100;
  if (mesh.has("points")) read_points_of_meshes(mesh, object.at("points"), json.contains("space"), problem);
  problem.domain.farfield_radius = mesh.get<double>("farfield_radius", 25.0);
  problem.gradation = mesh.find<double>("gradation");
  problem.wake = wake_given(mesh);
  if (!mesh.has("layers")) return;
  if (!has_friction)
    mesh.fail("found 'layers' without friction, expected 'model' and 'reynolds' at all points");
  // Points that are no good are refused later, by their place.
  const bool are_good =
      std::all_of(problem.points.begin(), problem.points.end(), [](const DesignPoint& point) {
        const double reynolds = point.conditions.reynolds;
        return point.model != FlowModel::euler && reynolds >= 1.0 && reynolds <= 1e10;
      });
  problem.layer =
      layer_given(object.at("layers"), file + ", mesh, layers",
                  are_good ? layer_for_points(problem.points, json.contains("space")) : LayerOptions());
}

// Unless the file says otherwise, the stations are those of the domain that is deformed.
void read_deformation(const Keys& keys, const Json& json, const std::string& file, DesignProblem& problem) {
  for (const char* key : {"degree", "symmetric", "target"})
    if (keys.has(key)) keys.fail("found '" + std::string(key) + "' with 'space', expected 'airfoil'");
  problem.deformation = read_space(keys, json, file, problem.domain, problem.warnings);
  const Json mesh = object_of(json, "mesh");
  const bool has_friction = problem.points.front().model != FlowModel::euler;
  if (!mesh.contains("points") && !has_friction)
    problem.domain.points = static_cast<int>(stations_on_walls(problem.deformation->domain));
}

// Of the section that a constraint is of: what it contains is given with as many coefficients.
int degree_of(const DesignConstraint& constraint, const DesignProblem& problem, int degree) {
  for (const DesignElement& element : problem.elements)
    if (constraint.element == element.name) return element.airfoil.degree();
  return problem.elements.empty() && !problem.deformation ? problem.airfoil.degree() : degree;
}

DesignConstraint constraint_of(const Json& entry, const std::string& where, DesignProblem& problem,
                               int degree, const std::filesystem::path& directory) {
  const Keys keys(entry, where,
                  {"kind", "point", "at_least", "at_most", "of_start", "x", "airfoil", "element", "between"});
  DesignConstraint result{.kind = keys.get<std::string>("kind"),
                          .at_least = keys.find<double>("at_least"),
                          .at_most = keys.find<double>("at_most"),
                          .of_start = keys.find<double>("of_start"),
                          .x = keys.find<std::vector<double>>("x"),
                          .element = keys.find<std::string>("element"),
                          .between = keys.find<std::vector<std::string>>("between")};
  if (keys.has("point")) result.point = keys.whole<std::size_t>("point", {}, 0, problem.points.size() - 1);
  if (keys.has("airfoil"))
    result.airfoil =
        section_named(keys, "airfoil", degree_of(result, problem, degree), directory, problem.warnings);
  return result;
}

// Whether a number of the design goes as far as the designer's `bounds` say.
bool has_bounds_to_be_given(const DesignProblem& problem) {
  if (!problem.deformation)
    return problem.elements.empty() ||
           std::any_of(problem.elements.begin(), problem.elements.end(),
                       [](const DesignElement& element) { return element.coefficients; });
  const auto has_none = [](const DeformationPart& part) {
    return std::visit([](const auto& of) { return !of.range.bounds; }, part);
  };
  return std::any_of(problem.deformation->parts.begin(), problem.deformation->parts.end(), has_none);
}

// Throws for keys that this designer has no use for.
void require_keys_of_designer(const Keys& keys, const DesignProblem& problem) {
  const bool is_cmaes = problem.designer == "cmaes";
  const std::string expected = is_cmaes ? "evaluations, sigma, seed, workers" : "evaluations, bounds, trust";
  for (const char* key : {"bounds", "trust", "sigma", "seed", "workers"})
    if (keys.has(key) && expected.find(key) == std::string::npos)
      keys.fail("found the key '" + std::string(key) + "', which '" + problem.designer +
                "' has no use for, expected " + expected);
  if (keys.has("bounds") && !has_bounds_to_be_given(problem))
    keys.fail(
        problem.deformation
            ? "found the key 'bounds', which deformations have of their own, expected it where one has none"
            : "found the key 'bounds', which is of coefficients, expected it where an element has "
              "\"coefficients\": true");
}

void read_designer(const Keys& keys, DesignProblem& problem) {
  problem.designer = keys.get<std::string>("name", "sqp");
  problem.evaluations = keys.whole<std::size_t>("evaluations", 100, 1, 1000000);
  problem.bounds = keys.get<double>("bounds", problem.bounds);
  problem.trust = keys.get<double>("trust", problem.trust);
  problem.sigma = keys.get<double>("sigma", problem.sigma);
  problem.seed = keys.whole<std::uint64_t>("seed", 1, 0, UINT64_MAX);
  problem.workers = keys.whole<std::size_t>("workers", 1, 1, 1000);
}

void read_points(const Keys& keys, const std::string& file, DesignProblem& problem) {
  for (const Json& entry : keys.list("flow", most_points))
    problem.points.push_back(point_of(entry, file + ", flow " + std::to_string(problem.points.size() + 1)));
  if (problem.points.empty()) keys.fail("expected at least one point of 'flow'");
}

// Its path leads on from the problem's directory.
DesignStart start_given(const Json& json, const std::string& file) {
  const Keys keys(json, file + ", start", {"history", "design"});
  DesignStart start{.history = std::filesystem::path(file).parent_path() / keys.get<std::string>("history")};
  if (keys.has("design") && json.at("design") != "best")
    start.design = keys.whole<std::uint64_t>("design", {}, 1, 1000000);
  return start;
}

void read_lists(const Keys& keys, const std::string& file, int degree, DesignProblem& problem) {
  const std::filesystem::path directory = std::filesystem::path(file).parent_path();
  for (const Json& entry : keys.list("constraints", most_constraints))
    problem.constraints.push_back(
        constraint_of(entry, file + ", constraint " + std::to_string(problem.constraints.size() + 1), problem,
                      degree, directory));
  for (const Json& entry : keys.list("verify", most_verified))
    problem.verify.push_back(keys.whole_number<int>(entry, "verify", 8, 100000));
}

}  // namespace

DesignProblem read_design_problem(const std::string& file) {
  constexpr std::size_t most_bytes = std::size_t{16} << 20;
  return parse_design_problem(read_text(file, most_bytes), file);
}

DesignProblem parse_design_problem(const std::string& text, const std::string& file) {
  const Json json = parse_design_json(text, file);
  const Keys keys(json, file,
                  {"airfoil", "elements", "space", "degree", "symmetric", "mesh", "flow", "objective",
                   "target", "constraints", "constraint_tolerance", "designer", "start", "verify"});
  const std::filesystem::path directory = std::filesystem::path(file).parent_path();
  DesignProblem problem{.text = json.dump()};
  const int degree = keys.whole<int>("degree", usual_degree, 1, 30);
  const std::optional<int> given = keys.has("degree") ? std::optional(degree) : std::nullopt;
  if (keys.has("airfoil") + keys.has("elements") + keys.has("space") != 1)
    keys.fail("expected one of 'airfoil', 'elements' and 'space'");
  if (keys.has("airfoil")) {
    problem.airfoil = start_named(keys, "airfoil", given, degree, directory, problem.warnings);
    problem.symmetric = keys.get<bool>("symmetric", false);
  }
  read_points(keys, file, problem);
  read_mesh_options(json, file, problem);
  if (keys.has("elements")) {
    if (keys.has("symmetric")) keys.fail("found 'symmetric' with 'elements', expected 'airfoil'");
    problem.elements = read_elements(keys, file, given, problem.warnings);
  }
  if (keys.has("space")) read_deformation(keys, json, file, problem);
  problem.objective = keys.get<std::string>("objective");
  if (keys.has("target")) problem.target = section_named(keys, "target", degree, directory, problem.warnings);
  read_lists(keys, file, degree, problem);
  if (problem.constraints.empty() && keys.has("constraint_tolerance"))
    keys.fail("found 'constraint_tolerance' without 'constraints', expected both or none");
  problem.constraint_tolerance = keys.get<double>("constraint_tolerance", problem.constraint_tolerance);
  const Json designer_object = object_of(json, "designer");
  const Keys designer(designer_object, file + ", designer",
                      {"name", "evaluations", "bounds", "trust", "sigma", "seed", "workers"});
  read_designer(designer, problem);
  if (keys.has("start")) problem.start = start_given(json.at("start"), file);
  problem = with_first_design(std::move(problem), file);
  require_keys_of_designer(designer, problem);
  return problem;
}

}  // namespace remodel
