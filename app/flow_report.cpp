#include "flow_report.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include "number_text.h"
#include "remodel/mesh_derivative.h"

namespace remodel::app {
namespace {

constexpr const char* not_converged = " (not converged)";

Json if_determined(const FlowResult& flow, double value) {
  return flow.lift_determined ? Json(value) : Json(nullptr);
}

}  // namespace

double determined_lift(const FlowResult& flow) {
  return flow.lift_determined ? flow.cl : std::numeric_limits<double>::quiet_NaN();
}

Json to_json(const FlowResult& flow, const FlowConditions& conditions) {
  Json json{{"cl", if_determined(flow, flow.cl)},
            {"cd", flow.cd},
            {"cm", if_determined(flow, flow.cm)},
            {"alpha_deg", conditions.cl ? if_determined(flow, flow.alpha_deg) : Json(flow.alpha_deg)},
            {"mach", flow.mach},
            {"converged", flow.converged()},
            {"status", name_of(flow.status)}};
  if (flow.entropy_drag) json["entropy_drag"] = *flow.entropy_drag;
  if (flow.friction) {
    json["cd_pressure"] = flow.friction->cd_pressure;
    json["cd_friction"] = flow.friction->cd_friction;
    json["y_plus_max"] = flow.friction->y_plus_max;
    json["reynolds"] = flow.friction->reynolds;
    if (flow.friction->transition) json["transition"] = *flow.friction->transition;
    if (flow.friction->wall_temperature) {
      json["wall_temperature"] = *flow.friction->wall_temperature;
      json["heat"] = flow.friction->heat;
    }
  }
  if (!flow.reason.empty()) json["reason"] = flow.reason;
  json["residual"] = flow.residual;
  json["newton_steps"] = flow.newton_steps;
  json["coarse_steps"] = flow.coarse_steps;
  json["factorisations"] = flow.factorisations;
  json["krylov_iterations"] = flow.krylov_iterations;
  json["corrected_vertices"] = flow.corrected_vertices;
  json["solver"] = name_of(flow.solver);
  json["gmres_iterations"] = flow.gmres_iterations;
  json["memory_mb"] = flow.memory_mb;
  json["seconds"] = flow.seconds;
  json["warm"] = name_of(flow.start);
  json["origin"] = name_of(flow.origin);
  json["lift_determined"] = flow.lift_determined;
  json["warnings"] = flow.warnings;
  return json;
}

Json bodies_json(const std::vector<FlowBody>& bodies, bool lift_determined, bool has_friction) {
  Json list = Json::array();
  for (const FlowBody& body : bodies) {
    Json& entry = list.emplace_back(Json{{"name", body.name},
                                         {"cl", lift_determined ? Json(body.cl) : Json(nullptr)},
                                         {"cd", body.cd},
                                         {"cm", lift_determined ? Json(body.cm) : Json(nullptr)}});
    if (!has_friction) continue;
    entry["cd_pressure"] = body.cd_pressure, entry["cd_friction"] = body.cd_friction;
    entry["y_plus_max"] = body.y_plus_max;
  }
  return list;
}

namespace {

void add_bodies(Report& report, const FlowResult& flow) {
  if (flow.bodies.size() > 1)
    for (const FlowBody& body : flow.bodies)
      report.line("body " + body.name, "CL " + (flow.lift_determined ? short_text(body.cl) : not_determined) +
                                           ", CD " + short_text(body.cd) +
                                           (flow.converged() ? "" : not_converged));
  report.data("bodies", bodies_json(flow.bodies, flow.lift_determined, flow.friction.has_value()));
  Json openings = Json::array();
  for (const FlowOpening& opening : flow.openings) {
    openings.push_back({{"name", opening.name},
                        {"mass_flow", opening.mass_flow},
                        {"flow_angle_deg", opening.flow_angle_deg},
                        {"total_pressure", opening.total_pressure},
                        {"pressure", opening.pressure},
                        {"mach", opening.mach}});
    report.line("boundary " + opening.name,
                "mass flow " + short_text(opening.mass_flow) + ", Mach " + short_text(opening.mach) + " at " +
                    short_text(opening.flow_angle_deg) + " degrees, pressure " +
                    short_text(opening.pressure) + ", total " + short_text(opening.total_pressure) +
                    (flow.converged() ? "" : not_converged));
  }
  if (openings.empty()) return;
  report.data("openings", openings);
  if (const auto loss = loss_coefficient(flow); loss && flow.converged())
    report.figure("loss_coefficient", "loss coefficient", *loss);
}

}  // namespace

void add_flow_figures(Report& report, const FlowResult& flow, const FlowConditions& conditions) {
  const Json figures = to_json(flow, conditions);
  for (const auto& [key, value] : figures.items()) report.data(key, value);
  const auto figure = [&](const char* key, const char* label, const std::string& unit = "") {
    if (!figures.contains(key)) return;
    if (figures.at(key).is_null())
      report.line(label, not_determined);
    else
      report.figure(key, label, figures.at(key), unit);
  };
  const auto add_end = [&] {
    figure("converged", "converged"), figure("status", "ended"), figure("reason", "because");
  };
  if (!flow.converged()) {
    report.line("not converged", "what follows is where the search ended, and no flow");
    add_end();
  }
  const std::string mark = flow.converged() ? "" : not_converged + 1;  // behind the space of units
  figure("cl", "CL", mark), figure("cd", "CD", mark), figure("cm", "CM", mark);
  figure("entropy_drag", "CD by entropy", mark);
  figure("cd_pressure", "CD of pressure", mark), figure("cd_friction", "CD of friction", mark);
  figure("y_plus_max", "largest y+", mark), figure("reynolds", "Reynolds number");
  figure("transition", "transition of upper and lower sides", "chords");
  figure("wall_temperature", "temperature of walls, over the stream's");
  figure("heat", "heat that walls take, over the stream's", mark);
  figure("alpha_deg", "angle of attack", "degrees");
  figure("mach", "Mach number");
  if (flow.converged()) add_end();
  figure("residual", "residual, of undisturbed flow's");
  figure("origin", "found from");
  figure("newton_steps", "Newton steps");
  figure("factorisations", "factorisations");
  figure("krylov_iterations", "steps with older factors");
  figure("solver", "linear solver");
  if (flow.gmres_iterations > 0) figure("gmres_iterations", "steps of GMRES");
  figure("memory_mb", "factors", "MB");
  figure("seconds", "solving", "seconds");
  add_bodies(report, flow);
  report.data("history", flow.history);
}

namespace {

// The shape's numbers of a native mesh, and derivatives by them of those by points.
struct ShapeNumbers {
  std::vector<std::string> names;
  std::function<std::vector<double>(std::span<const Point>)> vjp;
};

// The loops that the interior moves along with: all closed ones but those of the far field alone.
std::vector<std::size_t> loops_of_walls(const Domain& domain, const std::vector<std::string>& farfield) {
  std::vector<std::size_t> loops;
  for (std::size_t l = 0; l < domain.loops.size(); ++l) {
    const Loop& loop = domain.loops[l];
    const auto is_far = [&](const Curve& curve) {
      return std::find(farfield.begin(), farfield.end(), curve.name) != farfield.end();
    };
    if (!loop.open && !std::all_of(loop.curves.begin(), loop.curves.end(), is_far)) loops.push_back(l);
  }
  return loops;
}

ShapeNumbers shape_numbers(const MeshInput& input, const std::vector<std::string>& farfield) {
  const Domain& domain = input.layered ? input.layered->domain() : input.living->domain();
  const std::vector<std::size_t> moving = loops_of_walls(domain, farfield);
  const std::vector<std::string> names = coefficient_names(domain);
  if (input.layered) {
    auto layered = std::make_shared<LayeredMeshDerivative>(*input.layered, moving);
    return {names, [=](auto by_points) { return layered->vjp(by_points); }};
  }
  auto plain = std::make_shared<MeshDerivative>(*input.living, moving);
  return {names, [=](auto by_points) { return plain->vjp(by_points); }};
}

}  // namespace

Json gradients_json(LivingFlow& living, const MeshInput& input, const FlowResult& flow,
                    const FlowConditions& conditions, const std::vector<std::string>& farfield) {
  const FlowGradients gradients = living.gradients();
  if (gradients.interrupted) return nullptr;
  const ShapeNumbers shape = shape_numbers(input, farfield);
  const std::vector<std::string>& names = shape.names;
  Json sections = Json::object(), others = Json::object(), mach = Json::object(), reynolds = Json::object();
  const auto place_of = [&](std::size_t i) -> Json& { return is_of_section(names[i]) ? sections : others; };
  for (std::size_t i = 0; i < names.size(); ++i) place_of(i)["names"].push_back(names[i]);
  sections["names"].push_back(conditions.cl ? "cl" : "alpha_deg");
  const auto note = [&](const char* name, const FlowGradient& gradient) {
    const std::vector<double> by = shape.vjp(gradient.points);
    for (std::size_t i = 0; i < names.size(); ++i) place_of(i)[name].push_back(by[i]);
    sections[name].push_back(conditions.cl ? gradient.cl : gradient.alpha_deg);
    mach[name] = gradient.mach;
    if (flow.friction) reynolds[name] = gradient.reynolds;
  };
  const auto note_if_determined = [&](const char* name, const FlowGradient& gradient) {
    if (flow.lift_determined) return note(name, gradient);
    for (Json* of : {&sections, &others, &mach}) (*of)[name] = nullptr;
  };
  note_if_determined("cl", gradients.cl), note("cd", gradients.cd), note_if_determined("cm", gradients.cm);
  if (flow.friction) note("cd_pressure", gradients.cd_pressure);
  if (conditions.cl) note_if_determined("alpha_deg", gradients.alpha_deg);
  Json json = std::move(sections);
  json["others"] = std::move(others);
  json["mach"] = std::move(mach);
  if (flow.friction) json["reynolds"] = std::move(reynolds);
  json["seconds"] = gradients.seconds;
  return json;
}

void add_gradients(Report& report, const Json& gradients) {
  report.data("gradient", gradients);
  report.line("gradients by", gradients["names"].dump());
  for (const auto& [key, label] :
       {std::pair{"cl", "CL"}, std::pair{"cd", "CD"}, std::pair{"cd_pressure", "CD of pressure"},
        std::pair{"cm", "CM"}, std::pair{"alpha_deg", "the angle, degrees"}})
    if (gradients.contains(key) && !gradients[key].is_null())
      report.line(std::string("gradient of ") + label, gradients[key].dump());
}

void add_error(Report& report, const FlowError& error) {
  if (!error.finer.converged()) return report.data("error", nullptr);
  const FlowResult& finer = error.finer;
  const bool determined = finer.lift_determined;
  report.data("error", {{"cl", if_determined(finer, error.cl)},
                        {"cd", error.cd},
                        {"cm", if_determined(finer, error.cm)},
                        {"alpha_deg", error.alpha_deg},
                        {"order", error.order},
                        {"finer",
                         {{"vertices", error.vertices},
                          {"cl", if_determined(finer, finer.cl)},
                          {"cd", finer.cd},
                          {"cm", if_determined(finer, finer.cm)},
                          {"alpha_deg", finer.alpha_deg},
                          {"newton_steps", finer.newton_steps},
                          {"seconds", finer.seconds}}}});
  const auto bar = [&](const char* label, double lacks, double on_finer) {
    char text[100];
    std::snprintf(text, sizeof text, "%.2g (on %zu vertices %.6g)", lacks, error.vertices, on_finer);
    report.line(label, text);
  };
  if (determined) bar("CL lacks about", error.cl, finer.cl);
  bar("CD lacks about", error.cd, finer.cd);
  if (determined) bar("CM lacks about", error.cm, finer.cm);
  if (error.alpha_deg != 0.0) bar("the angle lacks about", error.alpha_deg, finer.alpha_deg);
}

}  // namespace remodel::app
