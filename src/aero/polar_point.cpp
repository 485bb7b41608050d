#include "aero/polar_point.h"

namespace remodel::aero {

FlowResult without_fields(FlowResult flow) {
  for (auto* field : {&flow.density, &flow.velocity_x, &flow.velocity_y, &flow.pressure, &flow.history})
    *field = std::vector<double>();
  if (flow.friction)
    for (auto* field : {&flow.friction->cf, &flow.friction->y_plus, &flow.friction->viscosity_ratio,
                        &flow.friction->working})
      *field = std::vector<double>();
  return flow;
}

PolarPoint point_of(const MarchedFlow& marched, bool over_lift) {
  const FlowResult& flow = marched.flow;
  PolarPoint point;
  point.asked = marched.asked;
  point.reason = marched.reason;
  (over_lift ? point.cl : point.alpha_deg) = marched.value;
  if (!marched.tried) return point;
  point.converged = flow.converged();
  point.status = flow.status;
  point.newton_steps = flow.newton_steps;
  point.residual = flow.residual;
  point.start = flow.start;
  point.seconds = flow.seconds;
  point.warnings = flow.warnings;
  if (!flow.converged()) return point;
  point.alpha_deg = over_lift ? flow.alpha_deg : marched.value;
  if (flow.lift_determined)
    point.cl = flow.cl, point.cm = flow.cm;
  else if (over_lift)
    point.cl = point.alpha_deg = PolarPoint::none;
  point.cd = flow.cd;
  point.cd_pressure = flow.friction ? flow.friction->cd_pressure : flow.cd;
  point.cd_friction = flow.friction ? flow.friction->cd_friction : 0.0;
  if (flow.friction) point.y_plus_max = flow.friction->y_plus_max;
  return point;
}

}  // namespace remodel::aero
