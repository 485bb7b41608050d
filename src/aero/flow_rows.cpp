#include "aero/flow_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace remodel::aero {

namespace {

// The value that a row begins at.
std::size_t nearest_to_zero(const std::vector<double>& values) {
  const auto nearer = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end(), nearer) - values.begin());
}

// What a point of a row is made of: fields are the largest part of a flow by far.
FlowResult without_fields(FlowResult flow) {
  for (auto* field : {&flow.density, &flow.velocity_x, &flow.velocity_y, &flow.pressure, &flow.history})
    *field = std::vector<double>();
  if (flow.friction)
    for (auto* field : {&flow.friction->cf, &flow.friction->y_plus, &flow.friction->viscosity_ratio,
                        &flow.friction->working})
      *field = std::vector<double>();
  return flow;
}

}  // namespace

March FlowRows::march(const FlowConditions& conditions, const std::vector<double>& values, const Solve& solve,
                      const See& see) {
  living_.go_on_from(first_of_row_);
  first_of_row_ = {};
  alpha_deg_ = 0.0;
  const auto found = [&](double value) {
    if (see.before) see.before(value);
    FlowResult flow = find(conditions, value, solve);
    if (flow.converged()) {
      alpha_deg_ = flow.alpha_deg;
      if (first_of_row_.empty()) first_of_row_ = living_.keep();
      if (remembers_)
        known_[{conditions.mach, conditions.reynolds, value}] = {living_.keep(), flow.alpha_deg};
      if (see.found) see.found(value, flow);
    }
    return without_fields(std::move(flow));
  };
  return aero::march(values, nearest_to_zero(values),
                     {.find = found, .return_to_first = [&] { living_.go_on_from(first_of_row_); }}, march_);
}

FlowResult FlowRows::find(const FlowConditions& conditions, double value, const Solve& solve) {
  const auto known = known_.find({conditions.mach, conditions.reynolds, value});
  if (known == known_.end()) return search(conditions, value, solve);
  const KeptFlow last = living_.keep();
  const double alpha_deg = std::exchange(alpha_deg_, known->second.alpha_deg);
  living_.go_on_from(known->second.flow);
  FlowResult flow = search(conditions, value, solve);
  if (flow.status != FlowStatus::stalled || first_of_row_.empty()) return flow;
  living_.go_on_from(last);
  alpha_deg_ = alpha_deg;
  return search(conditions, value, solve);
}

// From nothing the angle for a lift may be one far beyond the largest lift, where the same lift is found
// again: so a row of lifts begins with the flow at an angle of 0.
FlowResult FlowRows::search(FlowConditions conditions, double value, const Solve& solve) {
  conditions.cl.reset();
  conditions.alpha_deg = over_lift_ ? alpha_deg_ : value;
  if (over_lift_) {
    if (living_.keep().empty())
      if (FlowResult start = solve(living_, conditions); !start.converged()) return start;
    conditions.cl = value;
  }
  return solve(living_, conditions);
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
