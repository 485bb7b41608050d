#include "flow/scheme/convective_flux.h"

namespace remodel::flow {

namespace {

constexpr std::size_t n = unknown_count;

// One side's reconstructed values, with their derivatives by the upwind difference, by the central one and by
// the vertex's own value.
struct Side {
  Unknowns<double> value, by_upwind, by_central, by_own;
  Unknowns<double> further, further_by_upwind, further_by_central;
};

Side reconstructed(const FaceInputs<double, double>& in, std::size_t side, double epsilon, double slopes) {
  using Two = Dual<2>;
  const double direction = side == 0 ? slopes : -slopes;
  Side result;
  for (std::size_t k = 0; k < n; ++k) {
    const double central = in.q[1][k] - in.q[0][k];
    const ReconstructionStep<Two> to =
        reconstruction_step<Two, Two>(in.end[side], Two::variable(2.0 * in.along[side][k] - central, 0),
                                      Two::variable(central, 1), epsilon);
    result.value[k] = in.q[side][k] + direction * to.step.value;
    result.by_upwind[k] = direction * to.step.slope[0], result.by_central[k] = direction * to.step.slope[1];
    result.by_own[k] = 1.0;
    result.further[k] = direction * to.further.value;
    result.further_by_upwind[k] = direction * to.further.slope[0];
    result.further_by_central[k] = direction * to.further.slope[1];
  }
  for (const std::size_t k : positive_unknowns) {
    const Two limited =
        positivity_limited(Two::variable(result.value[k], 0), Two::variable(in.q[side][k], 1));
    result.value[k] = limited.value;
    result.by_upwind[k] *= limited.slope[0], result.by_central[k] *= limited.slope[0];
    result.by_own[k] = limited.slope[0] + limited.slope[1];
  }
  return result;
}

}  // namespace

FaceDerivative ConvectiveFlux::derivative(const FaceInputs<double, double>& in) const {
  using Both = Dual<2 * n>;
  using One = Dual<1>;
  const double h = limiter * std::sqrt(in.edge.x * in.edge.x + in.edge.y * in.edge.y) / in.length,
               epsilon = h * h * h;
  const Point normal = {in.normal.x, in.normal.y};
  const Side sides[2] = {reconstructed(in, 0, epsilon, slopes), reconstructed(in, 1, epsilon, slopes)};
  Block by_value[2], by_further[2] = {{}, {}};
  FaceDerivative result;
  Unknowns<Both> value[2], q[2];
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < n; ++k) {
      value[side][k] = Both::variable(sides[side].value[k], k + n * side);
      q[side][k] = Both::variable(in.q[side][k], k + n * side);
    }
  const Fluxes<Both> flux = roe_flux<Both>(value[0], value[1], in.normal);
  const Both part = smoothness<Both>(q[0], q[1]);
  for (std::size_t z = 0; z < n * n; ++z)
    by_value[0][z] = flux[z / n].slope[z % n], by_value[1][z] = flux[z / n].slope[z % n + n];
  for (std::size_t side = 0; side < 2; ++side) {
    const double weight = correction_weight(in.end[side]);
    if (weight == 0.0) continue;
    const Fluxes<double> above =
        extrapolation_correction<double>(in.q[side], sides[side].value, sides[side].further, in.normal);
    Unknowns<One> along;  // the whole step that the flux is linear in
    for (std::size_t k = 0; k < n; ++k) {
      along[k].value = in.q[side][k];
      along[k].slope[0] = sides[side].value[k] - in.q[side][k] + sides[side].further[k];
    }
    const std::array<One, n* n> at_vertex = flux_derivative<One>(along, normal);
    const Block at_value = flux_derivative<double>(sides[side].value, normal);
    for (std::size_t z = 0; z < n * n; ++z) {
      result.by_state[side][z] += weight * part.value * at_vertex[z].slope[0];
      by_value[side][z] += weight * part.value * (at_vertex[z].value - at_value[z]);
      by_further[side][z] = weight * part.value * at_vertex[z].value;
      for (std::size_t end = 0; end < 2; ++end)
        result.by_state[end][z] += weight * above[z / n] * part.slope[z % n + n * end];
    }
  }
  // The upwind difference is twice the product with the gradient less the central one, b's value less a's.
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t z = 0; z < n * n; ++z) {
      const std::size_t k = z % n;
      const Side& of = sides[side];
      const double up = by_value[side][z] * of.by_upwind[k] + by_further[side][z] * of.further_by_upwind[k];
      const double central =
          by_value[side][z] * of.by_central[k] + by_further[side][z] * of.further_by_central[k] - up;
      result.by_along[side][z] = 2.0 * up;
      result.by_state[0][z] -= central, result.by_state[1][z] += central;
      result.by_state[side][z] += by_value[side][z] * of.by_own[k];
    }
  return result;
}

}  // namespace remodel::flow
