#include <utility>

#include "base/stopwatch.h"
#include "flow/living_flow/model_gradients.h"
#include "remodel/error.h"

namespace remodel::flow {

namespace {

// Rows of walls that say "the gas stands still", or how warm it is, follow no place and nothing that
// derivatives are by. Functions follow the momentum that is unbalanced there, and so does the lift's
// equation.
template <std::size_t N>
std::vector<Total> totals_of(const FrictionSystem<N>& system, const BlockState<N>& state,
                             std::span<const typename FrictionSystem<N>::ForceSlope> functions,
                             const std::vector<BlockIncrement<N>>& multipliers) {
  const auto lift = system.force_slope(state, {.lift = 1.0});
  std::vector<BlockVector<N>> weights;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    BlockVector<N>& weight = weights.emplace_back(multipliers[i].q);
    for (std::size_t v = 0; v < weight.size(); ++v)
      for (std::size_t k = 0; k < N; ++k)
        weight[v][k] = (system.is_replaced(v, k) ? 0.0 : -weight[v][k]) + functions[i].weight[v][k] -
                       multipliers[i].augmented[0] * lift.weight[v][k];
  }
  std::vector<ShapeSlope> by_flux = system.slopes_of_unbalanced(state, weights);
  std::vector<Total> result;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const auto [by_lift, by_condition] = multipliers[i].augmented;
    Total& total = result.emplace_back(Total{.shape = std::move(by_flux[i]), .condition = by_condition});
    for (std::size_t v = 0; v < total.shape.points.size(); ++v)
      total.shape.points[v] =
          total.shape.points[v] + functions[i].shape.points[v] - by_lift * lift.shape.points[v];
    // The limiter's length is the distance between two vertices.
    const Extent& extent = system.mesh().extent();
    const Point far = system.mesh().points()[extent.b] - system.mesh().points()[extent.a];
    const Point by_far = (total.shape.length * system.stream().length / dot(far, far)) * far;
    total.shape.points[extent.b] = total.shape.points[extent.b] + by_far;
    total.shape.points[extent.a] = total.shape.points[extent.a] - by_far;
    total.shape.mach += functions[i].shape.mach - by_lift * lift.shape.mach;
  }
  return result;
}

}  // namespace

template <std::size_t N>
FlowGradients gradients_of(const LastFlow<N>& last, const Viscosity& viscosity,
                           const std::vector<FlowFunctional>& functions, const WantedGradients& wanted,
                           BlockWholeMatrix<N>& matrix, Gradients<N>& gradients) {
  const Stopwatch watch;
  require_gradients(last.found());
  if (wanted.entropy_drag)
    throw Error(ErrorCode::argument, "entropy_drag", "asked for with friction, expected a flow without");
  const FrictionMesh mesh(*last.mesh, last.stream.transition);
  const FrictionSystem<N> system(mesh, last.stream, viscosity);
  const std::size_t size = last.mesh->size();
  FlowGradients result;
  result.functions.assign(functions.size(), {});
  using Slope = typename FrictionSystem<N>::ForceSlope;
  std::vector<Slope> slopes;
  std::vector<std::pair<FlowGradient*, double>> places;
  const auto add = [&](Slope slope, FlowGradient& place, double scale = 1.0) {
    slopes.push_back(std::move(slope)), places.push_back({&place, scale});
  };
  const auto none = [&] {
    Slope slope;
    slope.by_unknowns = zero_of<N>(size);
    slope.shape.points.resize(size), slope.weight.resize(size);
    return slope;
  };
  const double scale = reported_length(last.stream);
  if (wanted.lift) add(system.force_slope(last.state, {.lift = 1.0}), result.cl, scale);
  if (wanted.drag) {
    add(system.force_slope(last.state, {.drag = 1.0}), result.cd, scale);
    if (wanted.pressure_drag)
      add(system.force_slope(last.state, {.pressure_drag = 1.0}), result.cd_pressure, scale);
  }
  if (wanted.moment) add(system.force_slope(last.state, {.moment = 1.0}), result.cm, scale * scale);
  if (wanted.angle) {
    Slope angle = none();
    angle.by_unknowns.augmented[1] = 1.0 / one_degree;
    add(std::move(angle), result.alpha_deg);
  }
  for (std::size_t i = 0; i < functions.size(); ++i) {
    GivenSlope given = slope_of(functions[i], size);
    Slope slope = none();
    slope.shape = std::move(given.shape);
    for (std::size_t v = 0; v < size; ++v)
      for (std::size_t k = 0; k < unknown_count; ++k) slope.by_unknowns.q[v][k] = given.state[v][k];
    add(std::move(slope), result.functions[i]);
  }

  system.jacobian(last.state, matrix.of(system));
  std::vector<BlockIncrement<N>> by_unknowns;
  for (Slope& slope : slopes) by_unknowns.push_back(std::move(slope.by_unknowns));
  const std::vector<BlockIncrement<N>>* multipliers =
      gradients.multipliers(last, system, by_unknowns, result);
  if (multipliers == nullptr) return result;
  std::vector<Total> totals = totals_of<N>(system, last.state, slopes, *multipliers);
  for (std::size_t i = 0; i < places.size(); ++i)
    *places[i].first = gradient_of(std::move(totals[i]), places[i].second, last.stream);
  result.seconds = watch.seconds();
  return result;
}

template FlowGradients gradients_of<4>(const LastFlow<4>&, const Viscosity&,
                                       const std::vector<FlowFunctional>&, const WantedGradients&,
                                       BlockWholeMatrix<4>&, Gradients<4>&);
template FlowGradients gradients_of<5>(const LastFlow<5>&, const Viscosity&,
                                       const std::vector<FlowFunctional>&, const WantedGradients&,
                                       BlockWholeMatrix<5>&, Gradients<5>&);

}  // namespace remodel::flow
