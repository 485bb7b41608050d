#include "flow/living_flow/adjoint.h"

#include <algorithm>

#include "flow/linear/gmres.h"
#include "flow/scheme/forces.h"
#include "flow/search/policy.h"

namespace remodel::flow {

Adjoint::Adjoint(const FlowSystem& system, const State& state, const BlockRows& matrix,
                 std::span<const FaceDerivative> faces, Factors& factors, const Overlap& overlap,
                 const FlowOptions& options)
    : system_(system),
      state_(state),
      matrix_(matrix, system.augmented_columns(state), system.augmented_rows(state)),
      faces_(faces),
      factors_(factors),
      overlap_(overlap),
      options_(options) {
  if (!overlap.zone.empty()) {
    zone_ = rows_of(matrix, overlap.zone);
    ready_ = zone_lu_.factor(zone_, options.memory_mb) == Factored::done;
    if (!ready_) return;
  }
  const AugmentedRows& rows = matrix_.rows();
  for (std::size_t z = 0; z < augmented_count; ++z) {
    columns_[z] = overlap.to_vertices(factors.columns()[z]);
    small_[z] = {rows.corner[0][z] - rows.times(columns_[z]), rows.corner[1][z]};
  }
}

void Adjoint::precondition_vertices(Vector& x) {
  Vector rest(zone_.rows.size());
  if (!rest.empty()) {
    for (std::size_t r = 0; r < rest.size(); ++r) rest[r] = x[zone_.rows[r]];
    zone_lu_.solve_transposed(rest, 1);
    add_transposed(zone_, -1.0, rest, x);
  }
  Vector earlier = overlap_.to_rows(x);
  factors_.solve_transposed(earlier);
  x = overlap_.to_vertices(earlier);
  for (std::size_t r = 0; r < rest.size(); ++r)
    for (std::size_t k = 0; k < unknown_count; ++k) x[zone_.rows[r]][k] += rest[r][k];
}

void Adjoint::precondition(Increment& x) {
  const double s0 = x.augmented[0] - inner(columns_[0], x.q), s1 = x.augmented[1] - inner(columns_[1], x.q);
  const double determinant = small_[0][0] * small_[1][1] - small_[0][1] * small_[1][0];
  x.augmented = {(s0 * small_[1][1] - small_[0][1] * s1) / determinant,
                 (small_[0][0] * s1 - small_[1][0] * s0) / determinant};
  matrix_.rows().add_transposed(-x.augmented[0], x.q);
  precondition_vertices(x.q);
}

// With whole factors the residual is kept as small as rounding lets it by beginning anew once.
bool Adjoint::solve(const Increment& right, double most_solves, Increment& guess, int& iterations) {
  using Policy = SearchPolicy;
  const double wanted =
      std::clamp(options_.tolerance, Policy::least_adjoint, Policy::most_adjoint) * norm(right);
  const bool whole = factors_.whole();
  const GmresEnd end = gmres([&](const Increment& x) { return matrix_.transposed_times(x); },
                             [&](Increment& x) { precondition(x); }, right,
                             {.wanted = wanted,
                              .restart = whole ? Policy::adjoint_steps : factors_.restart(),
                              .rounds = whole ? Policy::adjoint_rounds : Policy::incomplete_adjoint_rounds,
                              .most_iterations = most_solves,
                              .observer = options_.observer},
                             guess);
  iterations += end.iterations;
  return end.in_time && end.residual <= Policy::rounding_slack * wanted;
}

std::optional<std::vector<Total>> Adjoint::totals(std::span<const FunctionalSlope> functions,
                                                  std::vector<Increment>& multipliers, double most_solves,
                                                  int& iterations) {
  if (!ready_) return std::nullopt;
  multipliers.resize(functions.size());
  std::vector<Vector> weights;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const int before = iterations;
    if (!solve({functions[i].state, functions[i].augmented}, most_solves, multipliers[i], iterations))
      return std::nullopt;
    most_solves -= iterations - before;
    weights.push_back(multipliers[i].q);
  }
  const std::vector<ShapeSlope> by_residual = system_.residual_slopes(state_, weights, faces_);
  const FunctionalSlope lift = slope_of(system_, state_, WallForce{.weight = {.lift = 1.0}});
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
    const Extent& extent = system_.mesh().extent();
    const Point far = system_.mesh().points()[extent.b] - system_.mesh().points()[extent.a];
    const Point by_far = (by_residual[i].length * system_.stream().length / dot(far, far)) * far;
    total.shape.points[extent.b] = total.shape.points[extent.b] - by_far;
    total.shape.points[extent.a] = total.shape.points[extent.a] + by_far;
    total.shape.mach += -by_residual[i].mach - by_lift * lift.shape.mach;
  }
  return result;
}

}  // namespace remodel::flow
