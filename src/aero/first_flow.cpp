#include "aero/first_flow.h"

#include <algorithm>
#include <array>
#include <utility>

#include "aero/flow_march.h"

namespace remodel::aero {

FlowResult by_easier_flows(const FlowConditions& conditions, FlowResult direct, const FindFlow& find) {
  constexpr double slow = 0.5;
  const double mach = conditions.mach < 1.0 ? std::min(slow, conditions.mach) : conditions.mach;
  const bool has_load = conditions.cl ? *conditions.cl != 0.0 : conditions.alpha_deg != 0.0;
  const bool is_lost = direct.status == FlowStatus::step_limit || direct.status == FlowStatus::stalled;
  if (!is_lost || (mach == conditions.mach && !has_load)) return direct;
  double seconds = direct.seconds;
  const auto at = [&](double part) {
    FlowConditions between = conditions;
    between.mach = mach + part * (conditions.mach - mach);
    between.alpha_deg *= part;
    if (between.cl) *between.cl *= part;
    FlowResult flow = find(between);
    seconds += flow.seconds;
    return flow;
  };
  constexpr std::array<double, 2> parts = {0.0, 1.0};
  March marched = march(parts, 0, {.find = at, .return_to_first = [] {}}, {.halvings = 3, .misses = 1});
  if (marched.interrupted) {
    direct.status = FlowStatus::interrupted, direct.reason = "interrupted";
    return direct;
  }
  MarchedFlow& last = marched.flows.back();
  if (last.value == 1.0 && last.tried && last.flow.converged()) direct = std::move(last.flow);
  direct.seconds = seconds;
  return direct;
}

}  // namespace remodel::aero
