#include <utility>

#include "base/stopwatch.h"
#include "flow/living_flow/model_gradients.h"
#include "flow/scheme/entropy_drag.h"
#include "flow/scheme/forces.h"
#include "remodel/error.h"

namespace remodel::flow {

GivenSlope slope_of(const FlowFunctional& function, std::size_t size) {
  const std::vector<double>* by[unknown_count] = {&function.density, &function.velocity_x,
                                                  &function.velocity_y, &function.pressure};
  const auto require_size = [&](std::size_t found, const char* what) {
    if (found == size) return;
    throw Error(ErrorCode::argument, "functional",
                "found derivatives by " + std::to_string(found) + " " + what + ", expected the mesh's " +
                    std::to_string(size) + " points");
  };
  require_size(function.pressure.size(), "pressures");
  require_size(function.points.size(), "points");
  GivenSlope result;
  result.shape.points = function.points;
  result.shape.mach = function.mach;
  result.state.resize(size);
  for (std::size_t k = 0; k < unknown_count; ++k) {
    if (by[k]->empty()) continue;
    require_size(by[k]->size(), "values");
    for (std::size_t v = 0; v < size; ++v) result.state[v][k] = (*by[k])[v];
  }
  return result;
}

namespace {

std::vector<Total> totals_of(const FlowSystem& system, const State& state,
                             std::span<const FunctionalSlope> functions,
                             std::span<const FaceDerivative> faces,
                             const std::vector<Increment>& multipliers) {
  std::vector<Vector> weights;
  for (const Increment& multiplier : multipliers) weights.push_back(multiplier.q);
  const std::vector<ShapeSlope> by_residual = system.residual_slopes(state, weights, faces);
  const FunctionalSlope lift = slope_of(system, state, WallForce{.weight = {.lift = 1.0}});
  std::vector<Total> result;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    // The augmented equations are "lift of the walls = lift of the vortex" and "angle, or lift = the given
    // one", whose derivative by the given one is -1.
    const auto [by_lift, by_condition] = multipliers[i].augmented;
    Total& total = result.emplace_back(Total{.shape = functions[i].shape, .condition = by_condition});
    for (std::size_t v = 0; v < total.shape.points.size(); ++v)
      total.shape.points[v] =
          total.shape.points[v] - by_residual[i].points[v] - by_lift * lift.shape.points[v];
    // The limiter's length is the distance between two vertices.
    const Extent& extent = system.mesh().extent();
    const Point far = system.mesh().points()[extent.b] - system.mesh().points()[extent.a];
    const Point by_far = (by_residual[i].length * system.stream().length / dot(far, far)) * far;
    total.shape.points[extent.b] = total.shape.points[extent.b] - by_far;
    total.shape.points[extent.a] = total.shape.points[extent.a] + by_far;
    total.shape.mach += -by_residual[i].mach - by_lift * lift.shape.mach;
  }
  return result;
}

}  // namespace

FlowGradients gradients_of(const LastFlow<unknown_count>& last, const std::vector<FlowFunctional>& functions,
                           const WantedGradients& wanted, WholeMatrix& matrix,
                           Gradients<unknown_count>& gradients) {
  const Stopwatch watch;
  require_gradients(last.found());
  const FlowSystem system(*last.mesh, last.stream);
  FlowGradients result;
  result.functions.assign(functions.size(), {});
  std::vector<FunctionalSlope> slopes;
  std::vector<std::pair<FlowGradient*, double>> places;
  const auto add = [&](FunctionalSlope slope, FlowGradient& place, double scale = 1.0) {
    slopes.push_back(std::move(slope)), places.push_back({&place, scale});
  };
  const auto force = [&](const Coefficients& weight) {
    return slope_of(system, last.state, WallForce{.weight = weight});
  };
  const double scale = reported_length(last.stream);
  const std::size_t size = last.mesh->size();
  if (wanted.lift) add(force({.lift = 1.0}), result.cl, scale);
  if (wanted.drag) add(force({.drag = 1.0}), result.cd, scale);
  if (wanted.moment) add(force({.moment = 1.0}), result.cm, scale * scale);
  if (wanted.angle) {
    FunctionalSlope angle;
    angle.shape.points.resize(size), angle.state.resize(size);
    angle.augmented[1] = 1.0 / one_degree;
    add(std::move(angle), result.alpha_deg);
  }
  if (wanted.entropy_drag) add(slope_of(system, last.state, EntropyDrag{}), result.entropy_drag, scale);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    GivenSlope given = slope_of(functions[i], size);
    FunctionalSlope slope;
    slope.shape = std::move(given.shape), slope.state = std::move(given.state);
    add(std::move(slope), result.functions[i]);
  }

  std::vector<FaceDerivative> faces;
  system.jacobian(last.state, matrix.of(system), &faces);
  std::vector<Increment> by_unknowns;
  for (const FunctionalSlope& slope : slopes) by_unknowns.push_back({slope.state, slope.augmented});
  const std::vector<Increment>* multipliers = gradients.multipliers(last, system, by_unknowns, result);
  if (multipliers == nullptr) return result;
  std::vector<Total> totals = totals_of(system, last.state, slopes, faces, *multipliers);
  for (std::size_t i = 0; i < places.size(); ++i)
    *places[i].first = gradient_of(std::move(totals[i]), places[i].second, last.stream);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace remodel::flow
