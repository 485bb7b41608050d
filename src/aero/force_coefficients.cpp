// Coefficients of forces, whose derivatives the flow has.

#include <stdexcept>

#include "aero/kinds.h"

namespace remodel {
namespace {

constexpr Limits any_coefficient = {-100.0, 100.0};

class Drag final : public FlowFunction {
  FlowValue at(const FlowView& of) const override { return {.value = of.flow.cd, .by_drag = 1.0}; }
  bool is_even() const override { return true; }
};

class PressureDrag final : public FlowFunction {
  FlowValue at(const FlowView& of) const override {
    return {.value = of.flow.friction->cd_pressure, .by_pressure_drag = 1.0};
  }
  bool needs_friction() const override { return true; }
};

class FrictionDrag final : public FlowFunction {
  FlowValue at(const FlowView& of) const override {
    return {.value = of.flow.friction->cd_friction, .by_drag = 1.0, .by_pressure_drag = -1.0};
  }
  bool needs_friction() const override { return true; }
};

class Lift final : public FlowFunction {
  FlowValue at(const FlowView& of) const override { return {.value = of.flow.cl, .by_lift = 1.0}; }
  bool needs_farfield() const override { return true; }
  bool is_given(const FlowConditions& conditions) const override { return conditions.cl.has_value(); }
};

class Moment final : public FlowFunction {
  FlowValue at(const FlowView& of) const override { return {.value = of.flow.cm, .by_moment = 1.0}; }
};

// Drag over lift is made small: it is smooth where drag is none.
class DragOverLift final : public FlowFunction {
  bool needs_farfield() const override { return true; }
  FlowValue at(const FlowView& of) const override {
    const double cl = of.flow.cl, cd = of.flow.cd;
    if (!(cl > 0.0)) throw std::runtime_error("the lift is not positive");
    return {.value = cd / cl, .by_drag = 1.0 / cl, .by_lift = -cd / (cl * cl)};
  }
};

template <class Function>
FlowFunctionPtr made(std::optional<std::size_t>) {
  return std::make_shared<Function>();
}

}  // namespace

extern constinit const FlowKind drag_kind = {.name = "drag",
                                             .objective = 1.0,
                                             .at_least = any_coefficient,
                                             .at_most = any_coefficient,
                                             .make = made<Drag>};
extern constinit const FlowKind pressure_drag_kind = {.name = "pressure_drag",
                                                      .objective = 1.0,
                                                      .at_least = any_coefficient,
                                                      .at_most = any_coefficient,
                                                      .make = made<PressureDrag>};
extern constinit const FlowKind friction_drag_kind = {.name = "friction_drag",
                                                      .objective = 1.0,
                                                      .at_least = any_coefficient,
                                                      .at_most = any_coefficient,
                                                      .make = made<FrictionDrag>};
extern constinit const FlowKind lift_kind = {.name = "lift",
                                             .objective = -1.0,
                                             .at_least = any_coefficient,
                                             .at_most = any_coefficient,
                                             .make = made<Lift>};
extern constinit const FlowKind moment_kind = {.name = "moment",
                                               .objective = -1.0,
                                               .at_least = any_coefficient,
                                               .at_most = any_coefficient,
                                               .make = made<Moment>};
extern constinit const FlowKind lift_over_drag_kind = {
    .name = "lift_over_drag", .objective = 1.0, .make = made<DragOverLift>};

}  // namespace remodel
