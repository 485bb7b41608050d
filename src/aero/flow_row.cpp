#include "aero/flow_row.h"

#include <algorithm>
#include <cmath>

namespace remodel::aero {

std::size_t nearest_to_zero(const std::vector<double>& values) {
  const auto nearer = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end(), nearer) - values.begin());
}

FlowResult find_at(LivingFlow& living, const RowSolve& solve, FlowConditions conditions, double value,
                   bool over_lift, double alpha_deg) {
  conditions.cl.reset();
  conditions.alpha_deg = over_lift ? alpha_deg : value;
  if (!over_lift) return solve(living, conditions);
  if (!living.keep().empty()) {
    conditions.cl = value;
    return solve(living, conditions);
  }
  FlowResult start = solve(living, conditions);
  if (!start.converged()) return start;
  conditions.cl = value;
  FlowResult flow = solve(living, conditions);
  // Both are what it took to find this flow from nothing.
  flow.start = start.start;
  flow.newton_steps += start.newton_steps, flow.coarse_steps += start.coarse_steps;
  flow.seconds += start.seconds;
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
  point.bodies = flow.bodies;
  return point;
}

}  // namespace remodel::aero
