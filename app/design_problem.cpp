#include "design_problem.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "design_elements.h"
#include "design_json.h"
#include "design_keys.h"
#include "remodel/sqp.h"

namespace remodel::app {

namespace {

// What a problem may have at most of each: more would not end, and is a mistake of whoever wrote the file.
constexpr std::size_t most_points = 1000, most_constraints = 1000, most_stations = 1000, most_verified = 100;
constexpr std::size_t most_functions = 10000;  // of all constraints together

// t of the upper surface at this x; the lower one has it at 1 - t.
double parameter_at(double x) {
  return std::acos(2.0 * x - 1.0) / (2.0 * M_PI);
}

// Adds factor times the height of a surface at x to a row.
void add_height(const CstAirfoil& like, double x, bool upper, double factor, SectionConstraint& constraint) {
  const std::size_t n = like.upper.size();
  std::vector<double> row(n);
  const double t = parameter_at(x);
  const CstStation at = cst_basis(upper ? t : 1.0 - t, like.degree(), like.e1, like.e2, row);
  constraint.row.resize(2 * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) constraint.row[(upper ? 0 : n) + i] += factor * row[i];
  constraint.bound -= factor * at.x * (upper ? like.te_upper : like.te_lower);
}

double height(const CstAirfoil& airfoil, double x, bool upper) {
  const double t = parameter_at(x);
  return airfoil.at(upper ? t : 1.0 - t).y;
}

// The area between both surfaces by the trapezoidal rule in t, which is exact to rounding for these sections.
SectionConstraint area(const CstAirfoil& like) {
  constexpr int pieces = 400;
  SectionConstraint sum;
  for (int i = 1; i < pieces; ++i) {
    const double angle = M_PI * i / pieces, x = 0.5 * (1.0 + std::cos(angle));
    const double width = 0.5 * std::sin(angle) * M_PI / pieces;
    add_height(like, x, true, width, sum), add_height(like, x, false, -width, sum);
  }
  return sum;
}

// The difference of both surfaces' slopes at the trailing edge, of what points behind it: there (e2 = 1) a
// surface falls by its last coefficient.
SectionConstraint trailing_edge_slopes(const CstAirfoil& like) {
  const std::size_t n = like.upper.size();
  SectionConstraint difference{.row = std::vector<double>(2 * n, 0.0),
                               .bound = like.te_upper - like.te_lower};
  difference.row[n - 1] = 1.0, difference.row[2 * n - 1] = -1.0;
  return difference;
}

// The root of twice a surface's radius of curvature at the leading edge (e1 = 1/2): its first coefficient.
// Source: B. Kulfan, "Universal Parametric Geometry Representation Method", 2008.
SectionConstraint leading_edge_root(const CstAirfoil& like, bool upper) {
  const std::size_t n = like.upper.size();
  SectionConstraint root{.row = std::vector<double>(2 * n, 0.0), .bound = 0.0};
  root.row[upper ? 0 : n] = upper ? 1.0 : -1.0;
  return root;
}

double value_of(const SectionConstraint& function, const CstAirfoil& airfoil) {
  double sum = 0.0;
  const std::size_t n = airfoil.upper.size();
  for (std::size_t i = 0; i < n; ++i)
    sum += function.row[i] * airfoil.upper[i] + function.row[n + i] * airfoil.lower[i];
  return sum - function.bound;
}

// Throws where the lower surface is not the upper one's mirror image, but for the rounding of coordinates.
void require_symmetric(const Keys& keys, const CstAirfoil& airfoil) {
  constexpr double rounding = 1e-4;  // of files with four decimals, in chords
  constexpr int stations = 40;
  double worst = std::fabs(airfoil.te_upper + airfoil.te_lower);
  for (int i = 1; i < stations; ++i) {
    const double t = 0.5 * i / stations;
    worst = std::max(worst, std::fabs(airfoil.at(t).y + airfoil.at(1.0 - t).y));
  }
  if (worst > rounding)
    keys.fail("found an airfoil as 'airfoil' whose surfaces differ by " + Json(worst).dump() +
              " chords, expected a symmetric one for 'symmetric'");
}

// "at_least" or "of_start", one of them.
bool is_of_start(const Keys& keys) {
  if (keys.has("at_least") == keys.has("of_start")) keys.fail("expected one of at_least and of_start");
  return keys.has("of_start");
}

// A section whose shape is constrained, as it is at the start.
struct ConstrainedSection {
  std::size_t index = 0;
  CstAirfoil start;
};

std::size_t element_named(const Keys& keys, const std::string& name, const ElementSpace& elements) {
  const std::optional<std::size_t> found = elements.find(name);
  if (!found) keys.fail("found '" + name + "', expected the name of an element");
  return *found;
}

ConstrainedSection constrained_section(const Keys& keys, const DesignProblemFile& problem) {
  if (!problem.elements) return {0, problem.start};
  const ElementSpace& elements = *problem.elements;
  const auto name = keys.get<std::string>("element");
  const std::size_t index = element_named(keys, name, elements);
  if (!elements.has_coefficients(index))
    keys.fail("found '" + name + "' as 'element', whose coefficients are no variables");
  return {index, elements.section(elements.start(), index)};
}

// Angles and radii as linear constraints of what they follow from.
void add_edge_constraints(const Keys& keys, bool is_angle, const ConstrainedSection& section,
                          DesignProblemFile& problem) {
  const CstAirfoil& start = section.start;
  if (start.e1 != 0.5 || start.e2 != 1.0)
    keys.fail("found an airfoil of another class, expected one that is round in front and sharp behind");
  std::vector<SectionConstraint> functions;
  if (is_angle) {
    functions = {trailing_edge_slopes(start)};
  } else {
    functions = {leading_edge_root(start, true)};
    if (!problem.symmetric) functions.push_back(leading_edge_root(start, false));
  }
  for (SectionConstraint& function : functions) {
    double least = 0.0;
    if (is_of_start(keys)) {
      const double part = keys.number("of_start", {}, 0.0, 10.0);
      const double of_start = value_of(function, start);
      if (!(of_start > 0.0))
        keys.fail("found 'of_start' of " + std::string(is_angle ? "an angle" : "a radius") +
                  " that the start has not, expected at_least");
      const double half = part * std::atan(0.5 * of_start);
      if (is_angle && half > 0.25 * M_PI)
        keys.fail("found an 'of_start' that is " + Json(half * 360.0 / M_PI).dump() +
                  " degrees, expected 90 at most");
      least = is_angle ? 2.0 * std::tan(half) : std::sqrt(part) * of_start;
    } else {
      const double value = keys.number("at_least", {}, 0.0, is_angle ? 90.0 : 1.0);
      least = is_angle ? 2.0 * std::tan(value * M_PI / 360.0) : std::sqrt(2.0 * value);
    }
    function.bound += least;
    function.section = section.index;
    problem.section.push_back(std::move(function));
  }
}

// Throws for keys that a constraint of this kind has no use for.
void require_keys_of(const Keys& keys, const std::string& kind, bool has_elements) {
  const bool is_coefficient = kind == "lift" || kind == "moment" || kind == "drag";
  const bool is_flow = is_coefficient || kind == "suction";
  const auto refuse = [&](std::initializer_list<const char*> useless) {
    for (const char* key : useless)
      if (keys.has(key)) keys.fail("found the key '" + std::string(key) + "', which '" + kind + "' has not");
  };
  if (kind != "thickness") refuse({"x"});
  if (kind != "contains") refuse({"airfoil"});
  if (kind != "gap") refuse({"between"});
  if (!is_flow) refuse({"point", "at_most"});
  if (is_flow || kind == "contains" || kind == "gap") refuse({"of_start"});
  if (kind == "contains" || kind == "suction") refuse({"at_least"});
  if (is_coefficient || kind == "gap" || !has_elements) refuse({"element"});
}

void add_containment(const Keys& keys, const ConstrainedSection& section, DesignProblemFile& problem) {
  const CstAirfoil inner = section_named(keys, "airfoil", section.start.degree(), problem.directory);
  constexpr int stations = containment_stations + 1;
  for (int i = 1; i < stations; ++i)
    for (const bool upper : {true, false}) {
      if (problem.symmetric && !upper) continue;
      const double x = 0.5 * (1.0 + std::cos(M_PI * i / stations)), sign = upper ? 1.0 : -1.0;
      SectionConstraint constraint{
          .row = {}, .bound = sign * height(inner, x, upper), .section = section.index};
      add_height(section.start, x, upper, sign, constraint);
      problem.section.push_back(std::move(constraint));
    }
}

// Area, or thickness at stations.
void add_size_constraints(const Keys& keys, bool is_area, const ConstrainedSection& section,
                          DesignProblemFile& problem) {
  std::vector<SectionConstraint> functions;
  std::vector<double> stations;
  if (is_area)
    functions.push_back(area(section.start));
  else if ((stations = keys.get<std::vector<double>>("x")).empty())
    keys.fail("found no number in 'x', expected at least one");
  keys.require_at_most(stations.size(), "x", most_stations);
  for (const double x : stations) {
    if (!(x > 0.0 && x < 1.0))
      keys.fail("found " + Json(x).dump() + " in 'x', expected numbers above 0 and below 1");
    functions.emplace_back();
    add_height(section.start, x, true, 1.0, functions.back());
    add_height(section.start, x, false, -1.0, functions.back());
  }
  for (SectionConstraint& function : functions) {
    const double least = is_of_start(keys)
                             ? keys.number("of_start", {}, 0.0, 10.0) * value_of(function, section.start)
                             : keys.number("at_least", {}, 0.0, 10.0);
    function.bound += least;
    function.section = section.index;
    problem.section.push_back(std::move(function));
  }
}

void add_gap(const Keys& keys, DesignProblemFile& problem) {
  if (!problem.elements) keys.fail("found 'gap', expected it with 'elements' alone");
  const auto names = keys.get<std::vector<std::string>>("between");
  if (names.size() != 2 || names[0] == names[1])
    keys.fail("found " + Json(names).dump() + " as 'between', expected the names of two elements");
  problem.gaps.push_back({.section = element_named(keys, names[0], *problem.elements),
                          .other = element_named(keys, names[1], *problem.elements),
                          .at_least = keys.number("at_least", {}, 1e-6, 10.0)});
}

void add_flow_constraint(const Keys& keys, const std::string& kind, DesignProblemFile& problem) {
  FlowConstraint constraint{.of = kind == "lift"     ? "cl"
                                  : kind == "drag"   ? "cd"
                                  : kind == "moment" ? "cm"
                                                     : kind,
                            .point = keys.whole<std::size_t>("point", 0, 0, problem.points.size() - 1)};
  if (kind == "suction") {
    constraint.value = keys.number("at_most", {}, 0.1, 1000.0);
    if (keys.has("element"))
      constraint.section = element_named(keys, keys.get<std::string>("element"), *problem.elements);
  } else {
    if (keys.has("at_least") == keys.has("at_most")) keys.fail("expected one of at_least and at_most");
    constraint.sign = keys.has("at_most") ? 1.0 : -1.0;
    constraint.value = keys.number(keys.has("at_most") ? "at_most" : "at_least", {}, -100.0, 100.0);
  }
  if (kind == "lift" && problem.points[constraint.point].conditions.cl)
    keys.fail("found 'lift' of a point whose 'cl' is given, expected 'alpha_deg' alone there");
  problem.flow.push_back(constraint);
}

// Returns its kind.
std::string add_constraint(const Json& entry, const std::string& where, DesignProblemFile& problem) {
  const Keys keys(entry, where,
                  {"kind", "point", "at_least", "at_most", "of_start", "x", "airfoil", "element", "between"});
  const std::string kind = keys.word("kind", {},
                                     {"lift", "moment", "drag", "suction", "gap", "area", "thickness",
                                      "contains", "trailing_edge_angle", "leading_edge_radius"});
  require_keys_of(keys, kind, problem.elements.has_value());
  if (kind == "gap") {
    add_gap(keys, problem);
  } else if (kind == "lift" || kind == "moment" || kind == "drag" || kind == "suction") {
    add_flow_constraint(keys, kind, problem);
  } else {
    const ConstrainedSection section = constrained_section(keys, problem);
    if (kind == "trailing_edge_angle" || kind == "leading_edge_radius")
      add_edge_constraints(keys, kind == "trailing_edge_angle", section, problem);
    else if (kind == "contains")
      add_containment(keys, section, problem);
    else
      add_size_constraints(keys, kind == "area", section, problem);
  }
  return kind;
}

DesignPoint point_of(const Json& entry, const std::string& where) {
  const Keys keys(entry, where, {"mach", "alpha_deg", "cl", "weight"});
  DesignPoint point;
  point.conditions.mach = keys.number("mach", {}, 0.01, 3.0);
  point.conditions.alpha_deg = keys.number("alpha_deg", 0.0, -90.0, 90.0);
  if (keys.has("cl")) {
    point.conditions.cl = keys.number("cl", {}, -10.0, 10.0);
    if (point.conditions.mach > 1.0)
      keys.fail(
          "found 'cl' with a 'mach' above 1, expected 'alpha_deg': lift is given below the speed of sound");
  }
  point.weight = keys.number("weight", 1.0, 0.0, 1e6);
  return point;
}

void read_section(const Keys& keys, int degree, DesignProblemFile& problem) {
  problem.start = section_named(keys, "airfoil", degree, problem.directory);
  problem.symmetric = keys.get<bool>("symmetric", false);
  if (!problem.symmetric) return;
  require_symmetric(keys, problem.start);
  problem.start.te_lower = -problem.start.te_upper;
  for (std::size_t i = 0; i < problem.start.upper.size(); ++i)
    problem.start.lower[i] = -problem.start.upper[i];
}

void read_objective(const Keys& keys, int degree, DesignProblemFile& problem) {
  problem.objective = keys.word("objective", {}, {"drag", "lift", "lift_over_drag", "moment", "inverse"});
  if (problem.objective == "lift")
    for (const DesignPoint& point : problem.points)
      if (point.conditions.cl) keys.fail("found the objective 'lift' with 'cl', expected 'alpha_deg' alone");
  const bool is_inverse = problem.objective == "inverse";
  if (is_inverse && problem.elements)
    keys.fail("found the objective 'inverse' with 'elements', expected 'airfoil'");
  if (is_inverse) problem.target = section_named(keys, "target", degree, problem.directory);
  if (!is_inverse && keys.has("target"))
    keys.fail("found 'target' with the objective '" + problem.objective + "', expected 'inverse'");
}

// The object of a key, empty where there is none.
Json object_of(const Json& problem, const char* key) {
  return problem.contains(key) ? problem.at(key) : Json::object();
}

void read_mesh_options(const Json& json, const std::string& file, DesignProblemFile& problem) {
  const Json object = object_of(json, "mesh");
  const Keys mesh(object, file + ", mesh", {"points", "gradation", "farfield_radius"});
  problem.domain.points = mesh.whole<int>("points", 100, 8, 100000);
  if (problem.domain.points % 2 != 0)
    mesh.fail("found " + std::to_string(problem.domain.points) + " as 'points', expected an even number");
  problem.domain.farfield_radius = mesh.number("farfield_radius", 25, 2, 1e6);
  problem.gradation = mesh.number("gradation", problem.domain.points / 50.0, 0.1, 1000);
}

// Each constraint of the file has one name, whatever the number of functions that it takes.
void read_constraints(const Keys& keys, const std::string& file, DesignProblemFile& problem) {
  const Json entries = keys.list("constraints", most_constraints);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t sections = problem.section.size(), gaps = problem.gaps.size(),
                      flows = problem.flow.size();
    const std::string kind =
        add_constraint(entries[i], file + ", constraint " + std::to_string(i + 1), problem);
    keys.require_at_most(problem.section.size() + problem.gaps.size() + problem.flow.size(),
                         "constraints, counting stations", most_functions);
    const auto is_of_kind = [&](const Json& other) {
      return other.is_object() && other.contains("kind") && other.at("kind") == kind;
    };
    const bool is_only = std::count_if(entries.begin(), entries.end(), is_of_kind) == 1;
    const std::string name = is_only ? kind : kind + " (constraint " + std::to_string(i + 1) + ")";
    const auto call = [&](auto& constraints, std::size_t from) {
      for (std::size_t k = from; k < constraints.size(); ++k) constraints[k].name = name;
    };
    call(problem.section, sections), call(problem.gaps, gaps), call(problem.flow, flows);
  }
  if (entries.empty() && keys.has("constraint_tolerance"))
    keys.fail("found 'constraint_tolerance' without 'constraints', expected both or none");
  problem.constraint_tolerance = keys.number("constraint_tolerance", problem.constraint_tolerance, 0.0, 1.0);
}

// A point without a weight is looked at for its constraints alone.
void require_weights(const Keys& keys, const std::string& file, const DesignProblemFile& problem) {
  bool any = false;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    any = any || problem.points[i].weight > 0.0;
    const bool is_constrained =
        std::any_of(problem.flow.begin(), problem.flow.end(),
                    [&](const FlowConstraint& constraint) { return constraint.point == i; });
    if (problem.points[i].weight == 0.0 && !is_constrained)
      throw Error(ErrorCode::format, file + ", flow " + std::to_string(i + 1),
                  "found 0 as 'weight' of a point that no constraint names, expected a number above 0");
  }
  if (!any) keys.fail("found 0 as 'weight' of each point of 'flow', expected a number above 0 of one");
}

// Throws for keys that this designer has no use for.
void require_keys_of_designer(const Keys& keys, const DesignProblemFile& problem) {
  const bool is_cmaes = problem.designer == "cmaes";
  const std::string expected = is_cmaes ? "evaluations, sigma, seed" : "evaluations, bounds, trust";
  for (const char* key : {"bounds", "trust", "sigma", "seed"})
    if (keys.has(key) && expected.find(key) == std::string::npos)
      keys.fail("found the key '" + std::string(key) + "', which '" + problem.designer +
                "' has no use for, expected " + expected);
  const auto has_coefficients = [&] {
    for (std::size_t i = 0; i < problem.elements->sections(); ++i)
      if (problem.elements->has_coefficients(i)) return true;
    return false;
  };
  if (keys.has("bounds") && problem.elements && !has_coefficients())
    keys.fail(
        "found the key 'bounds', which is of coefficients, expected it where an element has "
        "\"coefficients\": true");
}

void read_designer(const Json& json, const std::string& file, DesignProblemFile& problem) {
  const Json object = object_of(json, "designer");
  const Keys keys(object, file + ", designer", {"name", "evaluations", "bounds", "trust", "sigma", "seed"});
  problem.designer = keys.word("name", "sqp", {"sqp", "cmaes"});
  problem.evaluations = keys.whole<std::size_t>("evaluations", 100, 1, 1000000);
  problem.bounds = keys.number("bounds", 0.1, 1e-9, 10);
  problem.trust = keys.number("trust", 0.02, 1e-6, 10);
  problem.sigma = keys.number("sigma", 0.01, 1e-9, 10);
  problem.seed = keys.whole<std::uint64_t>("seed", 1, 0, UINT64_MAX);
  require_keys_of_designer(keys, problem);
}

}  // namespace

DesignProblemFile read_design_problem(const std::string& file) {
  const Json json = read_design_json(file);
  const Keys keys(json, file,
                  {"airfoil", "elements", "degree", "symmetric", "mesh", "flow", "objective", "target",
                   "constraints", "constraint_tolerance", "designer", "verify"});
  DesignProblemFile problem;
  problem.directory = std::filesystem::path(file).parent_path();
  problem.text = json.dump();
  const int degree = keys.whole<int>("degree", 5, 1, 30);
  if (keys.has("airfoil") == keys.has("elements")) keys.fail("expected one of 'airfoil' and 'elements'");
  if (keys.has("airfoil")) read_section(keys, degree, problem);
  read_mesh_options(json, file, problem);
  if (keys.has("elements")) {
    if (keys.has("symmetric")) keys.fail("found 'symmetric' with 'elements', expected 'airfoil'");
    problem.elements = read_elements(keys, file, degree, problem.domain);
  }
  for (const Json& entry : keys.list("flow", most_points))
    problem.points.push_back(point_of(entry, file + ", flow " + std::to_string(problem.points.size() + 1)));
  if (problem.points.empty()) keys.fail("expected at least one point of 'flow'");
  read_objective(keys, degree, problem);
  read_constraints(keys, file, problem);
  require_weights(keys, file, problem);
  read_designer(json, file, problem);
  for (const Json& entry : keys.list("verify", most_verified)) {
    problem.verify.push_back(keys.whole_number<int>(entry, "verify", 8, 100000));
    if (entry.get<int>() % 2 != 0) keys.fail("found " + entry.dump() + " in 'verify', expected even numbers");
  }
  return problem;
}

std::vector<std::string> DesignProblemFile::constraint_names() const {
  std::vector<std::string> names;
  const auto add = [&](const auto& constraints) {
    for (const auto& constraint : constraints) names.push_back(constraint.name);
  };
  add(section), add(gaps), add(flow);
  return names;
}

bool DesignProblemFile::is_half() const {
  const auto along_axis = [](const DesignPoint& point) {
    return point.conditions.alpha_deg == 0.0 && !point.conditions.cl;
  };
  const auto of_drag = [](const FlowConstraint& constraint) { return constraint.of == "cd"; };
  return symmetric && (objective == "drag" || objective == "inverse") && start.te_upper == 0.0 &&
         std::all_of(points.begin(), points.end(), along_axis) &&
         std::all_of(flow.begin(), flow.end(), of_drag);
}

std::unique_ptr<FlowSpace> DesignProblemFile::space() const {
  if (elements) return std::make_unique<ElementSpace>(*elements);
  return std::make_unique<SectionSpace>(start, section_options());
}

std::unique_ptr<Designer> make_designer(const DesignProblemFile& problem, const FlowSpace& space) {
  const std::vector<double> start = space.start();
  if (problem.designer == "cmaes")
    return std::make_unique<CmaesDesigner>(start, CmaesOptions{.sigma = problem.sigma, .seed = problem.seed});
  DesignBounds bounds = space.bounds(problem.bounds);
  return std::make_unique<SqpDesigner>(start, SqpOptions{.trust = problem.trust,
                                                         .low = std::move(bounds.low),
                                                         .high = std::move(bounds.high),
                                                         .metric = space.metric()});
}

}  // namespace remodel::app
