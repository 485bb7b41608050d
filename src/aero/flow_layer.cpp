#include "remodel/flow_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "remodel/error.h"

namespace remodel {

LayerOptions layer_for_flow(FlowModel model, double reynolds) {
  constexpr double y_plus = 1.0;
  // Of a laminar boundary layer's thickness at the end of a plate; at a nose it is a tenth as thick. With
  // 1/100 friction and pressure are told apart within 20 %, with 1/500 within 2 % (NACA 0012, Re 500, Mach
  // 0.01). Turbulent layers have lower cells by their y+ from Re 5e5 on.
  constexpr double laminar_part = 1.0 / 500.0, turbulent_part = 1.0 / 150.0;
  if (model == FlowModel::euler)
    throw Error(ErrorCode::argument, "model", "found euler, expected a model with friction: laminar or sa");
  const bool turbulent = model == FlowModel::sa;
  LayerOptions layer;
  layer.thickness = 1.2 * boundary_layer_thickness(reynolds);
  const double laminar = 5.0 / std::sqrt(reynolds);
  if (!turbulent) layer.thickness = std::max(layer.thickness, 1.2 * std::min(laminar, 0.5));
  layer.first_height =
      turbulent ? std::min(first_height(y_plus, reynolds), turbulent_part * laminar) : laminar_part * laminar;
  return layer;
}

WakeLine wake_at(double length, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  return {.length = length, .direction = {std::cos(angle), std::sin(angle)}};
}

namespace {

// Whether an outer boundary is the far field alone, as around airfoils: walls are the holes then.
bool is_around_bodies(const Domain& domain, const std::vector<std::string>& farfield) {
  for (const Loop& loop : domain.loops)
    if (!loop.open && loop.role == LoopRole::outer)
      for (const Curve& curve : loop.curves)
        if (std::find(farfield.begin(), farfield.end(), curve.name) == farfield.end()) return false;
  return true;
}

}  // namespace

std::vector<std::string> walls_of_flow(const Domain& domain, const FlowOptions& options) {
  if (is_around_bodies(domain, options.farfield) && options.symmetry.empty()) return {};
  std::vector<std::string> openings = options.symmetry;
  openings.insert(openings.end(), options.farfield.begin(), options.farfield.end());
  for (const FlowInlet& inlet : options.inlets) openings.push_back(inlet.name);
  for (const FlowOutlet& outlet : options.outlets) openings.push_back(outlet.name);
  for (const FlowPeriod& pair : options.periodic) openings.insert(openings.end(), {pair.name, pair.moved});
  for (const PeriodicPair& pair : domain.periodic) openings.insert(openings.end(), {pair.name, pair.moved});
  std::vector<std::string> walls;
  for (const Loop& loop : domain.loops) {
    if (loop.open || loop.role == LoopRole::internal) continue;
    for (const Curve& curve : loop.curves) {
      const auto has = [&](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), curve.name) != names.end();
      };
      if (!has(openings) && !has(walls)) walls.push_back(curve.name);
    }
  }
  return walls;
}

}  // namespace remodel
