#include "remodel/design_run.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "aero/deformed_space.h"
#include "aero/element_space.h"
#include "aero/layered_space.h"
#include "aero/problem_openings.h"
#include "aero/section_space.h"
#include "remodel/error.h"
#include "remodel/evaluation.h"

namespace remodel {

using RunJson = nlohmann::ordered_json;

double DesignRun::sum(const char* output) const {
  double total = 0.0;
  for (const EvaluationRecord& row : rows)
    if (const auto found = row.outputs.find(output); found != row.outputs.end()) total += found->second;
  return total;
}

std::optional<double> DesignRun::start_objective() const {
  const EvaluationRecord& first = rows.front();
  if (first.coefficients != first_design || !std::isfinite(first.objective)) return std::nullopt;
  return first.objective;
}

std::vector<NamedNumber> violations_of(const std::vector<std::string>& names, double tolerance,
                                       const std::vector<double>& constraints) {
  std::vector<NamedNumber> result;
  for (std::size_t i = 0; i < std::min(names.size(), constraints.size()); ++i) {
    auto found = std::find_if(result.begin(), result.end(),
                              [&](const NamedNumber& known) { return known.name == names[i]; });
    if (found == result.end()) found = result.insert(result.end(), {names[i], 0.0});
    found->value = std::max(found->value, constraints[i] > tolerance ? constraints[i] : 0.0);
  }
  return result;
}

std::vector<NamedNumber> DesignRun::violations() const {
  return violations_of(constraint_names, constraint_tolerance, rows[best].constraints);
}

std::string DesignRun::why_no_design() const {
  if (!has_flow)
    return "no flow was found for any design: begin with a section, conditions and points for which `remodel "
           "flow` finds one";
  const std::vector<NamedNumber> by = violations();
  const auto worst = std::max_element(
      by.begin(), by.end(), [](const NamedNumber& a, const NamedNumber& b) { return a.value < b.value; });
  char amount[32];
  std::snprintf(amount, sizeof amount, "%.6g", worst->value);
  return "no design is within all constraints: the least violated one, design " +
         std::to_string(rows[best].evaluation) + ", violates '" + worst->name + "' most, by " + amount;
}

bool holds_design_run(const std::filesystem::path& directory) {
  const auto run = History::open(directory / "history.sqlite").run();
  const auto options = run.find("options");
  return options != run.end() && RunJson::accept(options->second) &&
         RunJson::parse(options->second).contains("problem");
}

namespace {

std::unique_ptr<FlowSpace> bodies_of(const RunJson& options, const std::string& file) {
  if (options.contains("elements"))
    return std::make_unique<ElementSpace>(ElementSpace::from_description(options.dump(), file));
  if (options.contains("deformed"))
    return std::make_unique<DeformedSpace>(DeformedSpace::from_description(options.dump(), file));
  const RunJson& space = options.at("space");
  return std::make_unique<SectionSpace>(
      airfoil_from_json(space.at("from").dump(), file),
      SectionSpaceOptions{.symmetric = options.at("problem").value("symmetric", false),
                          .half = options.at("half"),
                          .domain = {.points = space.at("points"),
                                     .farfield_radius = space.at("farfield_radius"),
                                     .farfield_points = space.at("farfield_points")}});
}

std::unique_ptr<const FlowSpace> space_of(const RunJson& options, const std::string& file) {
  std::unique_ptr<FlowSpace> bodies = bodies_of(options, file);
  if (!options.contains("layers")) return bodies;
  return LayeredSpace::from_description(std::move(bodies), options.dump());
}

// Of the designs whose flows were found, the row of the one that violates its worst constraint least, of
// several the first; without a flow the first row.
std::size_t least_violated(const std::vector<EvaluationRecord>& rows) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (std::isfinite(rows[i].objective) &&
        (!std::isfinite(rows[least].objective) ||
         violation_of(rows[i].constraints) < violation_of(rows[least].constraints)))
      least = i;
  return least;
}

}  // namespace

DesignRun read_design_run(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "history.sqlite";
  const History history = History::open(file);
  DesignRun run;
  try {
    const RunJson options = RunJson::parse(history.run().at("options"));
    const RunJson& problem = options.at("problem");
    run.problem = problem.dump();
    problem.at("objective").get_to(run.objective);
    run.space = space_of(options, file.string());
    run.first_design = options.value("first_design", run.space->start());
    options.at("constraint_names").get_to(run.constraint_names);
    run.constraint_tolerance = options.value("constraint_tolerance", 0.0);
    for (const RunJson& entry : problem.at("flow")) {
      DesignPoint& point = run.points.emplace_back();
      FlowConditions& at = point.conditions;
      at.mach = entry.at("mach"), at.alpha_deg = entry.value("alpha_deg", 0.0);
      at.reynolds = entry.value("reynolds", 0.0);
      if (entry.contains("transition")) at.transition = entry.at("transition").get<std::array<double, 2>>();
      if (entry.contains("cl")) at.cl = entry.at("cl").get<double>();
      read_openings(entry, file.string(), point);
      const std::string model = entry.value("model", name_of(FlowModel::euler));
      for (const FlowModel known : {FlowModel::laminar, FlowModel::sa})
        if (model == name_of(known)) point.model = known;
    }
  } catch (const std::out_of_range&) {
    throw Error(ErrorCode::format, file.string(), "found no run of `remodel design`");
  } catch (const RunJson::exception&) {
    throw Error(ErrorCode::format, file.string(), "found no run of `remodel design`");
  }
  run.rows = history.records();
  if (run.rows.empty())
    throw Error(ErrorCode::format, file.string(), "found no design, expected one or more");
  const std::size_t numbers = run.space->start().size();
  if (run.first_design.size() != numbers)
    throw Error(ErrorCode::format, file.string(), "found a first design of another number of variables");
  for (const EvaluationRecord& row : run.rows)
    if (row.coefficients.size() != numbers)
      throw Error(ErrorCode::format, file.string(),
                  "evaluation " + std::to_string(row.evaluation) + ": found a design of " +
                      std::to_string(row.coefficients.size()) + " numbers, expected " +
                      std::to_string(numbers));
  for (std::size_t i = 1; i < run.rows.size(); ++i)
    if (run.rows[i].best_objective < run.rows[run.best].best_objective) run.best = i;
  if (!run.has_best()) run.best = least_violated(run.rows);
  run.has_flow = std::isfinite(run.rows[run.best].objective);
  return run;
}

namespace {

// Of the loops of a domain but the far field, each piece between stations in a few straight ones.
std::vector<std::vector<Point>> outlines_of(const Domain& domain) {
  constexpr int pieces = 4;
  std::vector<std::vector<Point>> result;
  for (const Loop& loop : domain.loops) {
    if (loop.curves.front().name == "farfield") continue;
    const Frame frame(loop.placement);
    std::vector<Point>& outline = result.emplace_back();
    for (const Curve& curve : loop.curves)
      for (std::size_t i = 0; i < curve.parameters.size(); ++i) {
        const double from = curve.parameters[i];
        const double to = i + 1 < curve.parameters.size() ? curve.parameters[i + 1] : 1.0;
        for (int k = 0; k < pieces; ++k)
          outline.push_back(frame(point_at(curve.shape, from + (to - from) * k / pieces)));
      }
  }
  return result;
}

}  // namespace

std::vector<std::vector<Point>> outlines(const FlowSpace& space, std::span<const double> design) {
  constexpr int pieces = 400;
  if (space.sections() == 0) return outlines_of(space.bodies(design));
  std::vector<std::vector<Point>> result;
  for (std::size_t index = 0; index < space.sections(); ++index) {
    const CstAirfoil section = space.section(design, index);
    const Frame frame(space.placement(design, index));
    result.emplace_back();
    for (int i = 0; i < pieces; ++i)
      result.back().push_back(frame(section.at(static_cast<double>(i) / pieces)));
  }
  return result;
}

std::array<double, 4> window_of(const DesignRun& run, const std::array<double, 4>& of_one, double beside,
                                double above) {
  if (run.space->sections() == 1) return of_one;
  constexpr double far = 1e9;
  std::array<double, 4> box = {far, far, -far, -far};
  for (const std::vector<double>& design : {run.first_design, run.best_design()})
    for (const std::vector<Point>& outline : outlines(*run.space, design))
      for (const Point p : outline)
        box = {std::min(box[0], p.x), std::min(box[1], p.y), std::max(box[2], p.x), std::max(box[3], p.y)};
  const double width = box[2] - box[0];
  return {box[0] - beside * width, box[1] - above * width, box[2] + beside * width, box[3] + above * width};
}

}  // namespace remodel
