// What leaves a duct through its outlets: how much gas, with which total pressure, and in which direction.
// All by the trapezoidal rule over the edges of the outlets, of states at vertices.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "aero/kinds.h"
#include "aero/outlet_numbers.h"
#include "flow/physics/euler.h"

namespace remodel {
namespace {

constexpr double gamma = flow::gas_gamma;

// A number with its derivatives by density, velocity, pressure and the normal at one vertex of an edge.
struct AtVertex {
  double value = 0.0;
  double by[4] = {};
  Point by_normal;
};

AtVertex mass_at(const FlowResult& flow, std::uint32_t v, Point normal) {
  const double rho = flow.density[v];
  const Point velocity = {flow.velocity_x[v], flow.velocity_y[v]};
  const double speed = dot(velocity, normal);
  return {rho * speed, {speed, rho * normal.x, rho * normal.y, 0.0}, rho * velocity};
}

// The mass flow times the total pressure, p (1 + 0.2 M^2)^3.5.
AtVertex pressure_flow_at(const FlowResult& flow, std::uint32_t v, Point normal) {
  constexpr double half_g = 0.5 * (gamma - 1.0), power = gamma / (gamma - 1.0);
  const AtVertex mass = mass_at(flow, v, normal);
  const double rho = flow.density[v], p = flow.pressure[v];
  const double x = flow.velocity_x[v], y = flow.velocity_y[v];
  const double square = rho * (x * x + y * y) / (gamma * p), base = 1.0 + half_g * square;
  const double total = p * std::pow(base, power);
  const double by_square = p * power * std::pow(base, power - 1.0) * half_g;
  const double by[4] = {by_square * square / rho, by_square * 2.0 * rho * x / (gamma * p),
                        by_square * 2.0 * rho * y / (gamma * p), total / p - by_square * square / p};
  AtVertex result{mass.value * total, {}, total * mass.by_normal};
  for (std::size_t k = 0; k < 4; ++k) result.by[k] = mass.by[k] * total + mass.value * by[k];
  return result;
}

// The momentum that passes, along x or y.
template <double Point::*Along>
AtVertex momentum_at(const FlowResult& flow, std::uint32_t v, Point normal) {
  const AtVertex mass = mass_at(flow, v, normal);
  const bool is_x = Along == &Point::x;
  const double speed = is_x ? flow.velocity_x[v] : flow.velocity_y[v];
  AtVertex result{mass.value * speed, {}, speed * mass.by_normal};
  for (std::size_t k = 0; k < 4; ++k) result.by[k] = mass.by[k] * speed;
  result.by[is_x ? 1 : 2] += mass.value;
  return result;
}

FlowValue nothing_of(const FlowView& of) {
  const std::vector<double> none(of.frozen.points.size(), 0.0);
  return {.by_flow = FlowFunctional{.pressure = none,
                                    .points = std::vector<Point>(none.size()),
                                    .density = none,
                                    .velocity_x = none,
                                    .velocity_y = none}};
}

bool is_outlet(const FlowView& of, const std::string& name) {
  return std::any_of(of.flow.openings.begin(), of.flow.openings.end(), [&](const FlowOpening& opening) {
    return opening.name == name && opening.mass_flow < 0.0;
  });
}

// The integral over all outlets of what there is at vertices.
FlowValue over_outlets(const FlowView& of,
                       AtVertex (*at)(const FlowResult& flow, std::uint32_t v, Point normal)) {
  FlowValue sum = nothing_of(of);
  FlowFunctional& by = *sum.by_flow;
  std::vector<double>* const by_state[4] = {&by.density, &by.velocity_x, &by.velocity_y, &by.pressure};
  for (const FrozenBoundary& boundary : of.frozen.boundaries) {
    if (!is_outlet(of, boundary.name)) continue;
    for (const auto& [a, b] : boundary.edges) {
      const Point along = of.frozen.points[b] - of.frozen.points[a];
      for (const std::uint32_t v : {a, b}) {
        const AtVertex part = at(of.flow, v, {along.y, -along.x});  // the domain is on the left
        sum.value += 0.5 * part.value;
        for (std::size_t k = 0; k < 4; ++k) (*by_state[k])[v] += 0.5 * part.by[k];
        const Point by_along = 0.5 * Point{-part.by_normal.y, part.by_normal.x};
        by.points[b] = by.points[b] + by_along, by.points[a] = by.points[a] - by_along;
      }
    }
  }
  return sum;
}

void add_scaled(FlowFunctional& to, double factor, const FlowFunctional& from) {
  const auto add = [&](auto& values, const auto& others) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = values[i] + factor * others[i];
  };
  add(to.pressure, from.pressure), add(to.points, from.points), add(to.density, from.density);
  add(to.velocity_x, from.velocity_x), add(to.velocity_y, from.velocity_y);
}

class MassFlow final : public FlowFunction {
  FlowValue at(const FlowView& of) const override { return over_outlets(of, mass_at); }
  bool needs_outlets() const override { return true; }
};

// The mean by mass flow, as a part of the stream's.
class TotalPressure final : public FlowFunction {
 public:
  FlowValue at(const FlowView& of) const override {
    const FlowValue mass = over_outlets(of, mass_at), weighted = over_outlets(of, pressure_flow_at);
    if (!(mass.value > 0.0)) throw std::runtime_error("no gas leaves through outlets");
    const double mach = of.flow.mach, base = 1.0 + 0.2 * mach * mach;
    const double stream = std::pow(base, 3.5) / gamma, scale = 1.0 / (stream * mass.value);
    FlowValue result = nothing_of(of);
    result.value = scale * weighted.value;
    add_scaled(*result.by_flow, scale, *weighted.by_flow);
    add_scaled(*result.by_flow, -result.value / mass.value, *mass.by_flow);
    result.by_flow->mach = -result.value * 3.5 * 0.4 * mach / base;
    return result;
  }
  bool needs_outlets() const override { return true; }
};

// The loss coefficient of a row of blades: what total pressure lacks of the stream's, over the stream's
// dynamic pressure (its total less its static one).
class PressureLoss final : public FlowFunction {
 public:
  FlowValue at(const FlowView& of) const override {
    FlowValue total = TotalPressure().at(of);
    const double mach = of.flow.mach, base = 1.0 + 0.2 * mach * mach;
    const double dynamic = 1.0 - std::pow(base, -3.5), by_mach = 1.4 * mach * std::pow(base, -4.5);
    FlowValue result = nothing_of(of);
    result.value = (1.0 - total.value) / dynamic;
    add_scaled(*result.by_flow, -1.0 / dynamic, *total.by_flow);
    result.by_flow->mach = -(total.by_flow->mach + result.value * by_mach) / dynamic;
    return result;
  }
  bool needs_outlets() const override { return true; }
};

// The direction of the momentum, degrees to the x axis.
class FlowAngle final : public FlowFunction {
 public:
  FlowValue at(const FlowView& of) const override {
    const FlowValue x = over_outlets(of, momentum_at<&Point::x>),
                    y = over_outlets(of, momentum_at<&Point::y>);
    const double square = x.value * x.value + y.value * y.value;
    if (!(over_outlets(of, mass_at).value > 0.0)) throw std::runtime_error("no gas leaves through outlets");
    constexpr double degree = 0.017453292519943295;
    FlowValue result = nothing_of(of);
    result.value = std::atan2(y.value, x.value) / degree;
    add_scaled(*result.by_flow, -y.value / (square * degree), *x.by_flow);
    add_scaled(*result.by_flow, x.value / (square * degree), *y.by_flow);
    return result;
  }
  bool needs_outlets() const override { return true; }
  double unit(double) const override { return 180.0 / std::numbers::pi; }  // violations are in radians
};

template <class Function>
FlowFunctionPtr opening_function(std::optional<std::size_t>) {
  return std::make_shared<Function>();
}

}  // namespace

std::vector<std::pair<std::string, double>> outlet_numbers(const DesignPoint& point, const FlowView& of) {
  if (point.outlets.empty()) return {};
  const double mass = over_outlets(of, mass_at).value;
  if (!(mass > 0.0)) return {{"mass_flow", mass}};
  return {{"mass_flow", mass},
          {"total_pressure", TotalPressure().at(of).value},
          {"flow_angle", FlowAngle().at(of).value}};
}

double entering_total_pressure(const DesignPoint& point, const Domain& walls) {
  double most = 0.0;
  for (const Loop& loop : walls.loops)
    for (const Curve& curve : loop.curves)
      if (curve.name == "farfield") most = 1.0;
  for (const FlowInlet& inlet : point.inlets) most = std::max(most, inlet.total_pressure);
  return most;
}

std::string total_pressure_warning(double found, double entering) {
  constexpr double rounding = 1e-6;
  if (!(found > entering * (1.0 + rounding))) return {};
  char text[160];
  std::snprintf(
      text, sizeof text,
      "the total pressure at outlets is %.6g of the stream's where gas enters with %.6g: the mesh makes "
      "the rest, and a finer one less",
      found, entering);
  return text;
}

extern constinit const FlowKind mass_flow_kind = {.name = "mass_flow",
                                                  .objective = -1.0,
                                                  .at_least = Limits{0.0, 1e6},
                                                  .at_most = Limits{0.0, 1e6},
                                                  .make = opening_function<MassFlow>};
extern constinit const FlowKind total_pressure_kind = {.name = "total_pressure",
                                                       .objective = -1.0,
                                                       .at_least = Limits{0.0, 1e3},
                                                       .at_most = Limits{0.0, 1e3},
                                                       .make = opening_function<TotalPressure>};
extern constinit const FlowKind pressure_loss_kind = {.name = "pressure_loss",
                                                      .objective = 1.0,
                                                      .at_least = Limits{-1e3, 1e3},
                                                      .at_most = Limits{-1e3, 1e3},
                                                      .make = opening_function<PressureLoss>};
extern constinit const FlowKind flow_angle_kind = {.name = "flow_angle",
                                                   .objective = 1.0,
                                                   .at_least = Limits{-180.0, 180.0},
                                                   .at_most = Limits{-180.0, 180.0},
                                                   .make = opening_function<FlowAngle>};

}  // namespace remodel
