#include "aero/fresh_flows.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "aero/outlet_numbers.h"
#include "flow/solution.h"
#include "remodel/flow_error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

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

// With the angles that the search's first mesh has (OptimiseOptions::reference_slack_deg).
QualityOptions quality_of(const DesignProblem& problem, int points) {
  QualityOptions quality{.gradation = gradation_of(problem) * points / problem.domain.points};
  quality.refine_angle_deg = angle_with_slack(quality, design_slack_deg);
  return quality;
}

FreshMesh fresh_mesh(const FlowSpace& space, const Domain& walls, const QualityOptions& quality,
                     StepObserver& observer) {
  FreshMesh fresh;
  if (space.layers() != nullptr) {
    const LayeredGenerateResult made = generate_layered(walls, space.layers()->options(), quality, &observer);
    fresh.frozen = made.mesh.freeze(), fresh.stopped = made.stopped;
  } else {
    GenerateResult made = generate(walls, quality, &observer);
    fresh.frozen = made.mesh.freeze(), fresh.stopped = made.stopped;
    fresh.plain = std::move(made.mesh);
  }
  return fresh;
}

FlowResult flow_through(const FreshMesh& mesh, const FlowSpace& space, const DesignPoint& point,
                        StepObserver& observer, const OnFlowStep& on_step) {
  FlowOptions options = design_flow_options(space, point, &observer);
  options.on_step = on_step;
  FlowResult flow = mesh.plain.empty() ? solve_flow(mesh.frozen, point.conditions, options)
                                       : solve_flow(mesh.plain, point.conditions, options);
  return space.half() ? whole_of(std::move(flow)) : flow;
}

// By the two finest meshes of each point, if flows through both were found.
void add_errors(const std::vector<DesignPoint>& points, std::vector<FreshFlow>& verified) {
  for (std::size_t point = 0; point < points.size(); ++point) {
    FreshFlow *finest = nullptr, *next = nullptr;
    for (std::size_t i = point; i < verified.size(); i += points.size()) {
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
                     .cd = lacking_drag(rest * (finest->cd - next->cd), finest->cd,
                                        points[point].inlets.empty() && points[point].outlets.empty()),
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

FreshFlow fresh_flow(const FlowResult& flow, int points, std::size_t vertices) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {.points = points,
          .vertices = vertices,
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
          .violated = {},
          .seconds = flow.seconds,
          .mach_max = remodel::flow::largest_mach(flow)};
}

nlohmann::ordered_json json_of(const FreshFlow& flow) {
  nlohmann::ordered_json violated = nlohmann::ordered_json::object();
  for (const auto& [name, excess] : flow.violated) violated[name] = excess;
  nlohmann::ordered_json json = {{"points", flow.points},
                                 {"vertices", flow.vertices},
                                 {"mach", flow.mach},
                                 {"alpha_deg", flow.alpha_deg},
                                 {"cl", flow.cl},
                                 {"cd", flow.cd},
                                 {"cm", flow.cm},
                                 {"converged", flow.converged},
                                 {"violated", std::move(violated)},
                                 {"seconds", flow.seconds},
                                 {"mach_max", flow.mach_max}};
  if (flow.cd_pressure) json["cd_pressure"] = *flow.cd_pressure;
  if (flow.cd_friction) json["cd_friction"] = *flow.cd_friction;
  for (const NamedNumber& number : flow.outlets) json[number.name] = number.value;
  if (!flow.warning.empty()) json["warning"] = flow.warning;
  if (flow.error)
    json["error"] = {
        {"cl", flow.error->cl}, {"cd", flow.error->cd}, {"cm", flow.error->cm}, {"order", flow.error->order}};
  return json;
}

nlohmann::ordered_json json_of(const std::vector<FreshFlow>& flows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FreshFlow& flow : flows) list.push_back(json_of(flow));
  return list;
}

}  // namespace

double gradation_of(const DesignProblem& problem) {
  const bool has_friction = problem.points.front().model != FlowModel::euler;
  return problem.gradation.value_or(problem.domain.points / (has_friction ? 37.5 : 50.0));
}

Stopped add_fresh_flows(const DesignProblem& problem, const ResolvedProblem& parts,
                        std::span<const double> design, StepObserver& observer, const OnFlowStep& on_step,
                        std::vector<FreshFlow>& flows) {
  for (const int points : problem.verify) {
    const Domain walls = parts.space->domain_with(design, points);
    const FreshMesh mesh = fresh_mesh(*parts.space, walls, quality_of(problem, points), observer);
    if (mesh.stopped != Stopped::done) return mesh.stopped;
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      const FlowResult flow = flow_through(mesh, *parts.space, problem.points[i], observer, on_step);
      if (flow.status == FlowStatus::interrupted) return Stopped::interrupted;
      FreshFlow& fresh = flows.emplace_back(fresh_flow(flow, points, mesh.frozen.points.size()));
      fresh.violated = violated_by(parts, problem.constraint_tolerance, i, walls, mesh.frozen, flow);
      if (flow.converged()) add_outlets(problem.points[i], {walls, mesh.frozen, flow}, fresh);
    }
  }
  add_errors(problem.points, flows);
  return Stopped::done;
}

std::string fresh_json(const std::vector<FreshFlow>& flows) {
  return json_of(flows).dump();
}

void write_fresh(const DesignResult& result, const std::filesystem::path& directory) {
  const nlohmann::ordered_json file = {{"design", result.search.best_design},
                                       {"verified", json_of(result.verified)},
                                       {"verified_start", json_of(result.verified_start)}};
  write_text_atomically(directory / "fresh.json", file.dump() + "\n");
}

}  // namespace remodel
