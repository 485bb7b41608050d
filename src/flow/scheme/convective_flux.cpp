#include "flow/scheme/convective_flux.h"

namespace remodel::flow {

namespace {

// Its variables are both ends' values of one unknown, the product with the side's gradient and limited_part().
using Four = Dual<4>;

// One side's reconstructed values, and how much further linear extrapolation goes.
struct Side {
  Unknowns<Four> value, further;
};

Side reconstructed(const FaceInputs<double, double>& in, std::size_t side, double epsilon, double limited,
                   double slopes) {
  const double direction = side == 0 ? slopes : -slopes;
  Side result;
  for (std::size_t k = 0; k < unknown_count; ++k) {
    const Four q[2] = {Four::variable(in.q[0][k], 0), Four::variable(in.q[1][k], 1)};
    const Four central = q[1] - q[0];
    const auto [step, further] =
        reconstruction_step<Four, Four>(in.end[side], 2.0 * Four::variable(in.along[side][k], 2) - central,
                                          central, epsilon, Four::variable(limited, 3));
    result.value[k] = q[side] + direction * step, result.further[k] = direction * further;
  }
  for (const std::size_t k : positive_unknowns)
    result.value[k] = positivity_limited(result.value[k], Four::variable(in.q[side][k], side));
  return result;
}

}  // namespace

FaceDerivative ConvectiveFlux::derivative(const FaceInputs<double, double>& in) const {
  constexpr std::size_t n = unknown_count;
  using Both = Dual<2 * n>;
  using One = Dual<1>;
  const double h = limiter * std::sqrt(in.edge.x * in.edge.x + in.edge.y * in.edge.y) / in.length,
               epsilon = h * h * h;
  const Point normal = {in.normal.x, in.normal.y};
  const double limited = limited_part<double>(in.q[0], in.q[1]);
  const Side sides[2] = {reconstructed(in, 0, epsilon, limited, slopes),
                         reconstructed(in, 1, epsilon, limited, slopes)};
  Block by_value[2], by_further[2] = {{}, {}};
  FaceDerivative result;
  Unknowns<Both> value[2], q[2];
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < n; ++k) {
      value[side][k] = Both::variable(sides[side].value[k].value, k + n * side);
      q[side][k] = Both::variable(in.q[side][k], k + n * side);
    }
  const Fluxes<Both> flux = roe_flux<Both>(value[0], value[1], in.normal);
  const Both part = smoothness<Both>(q[0], q[1]);
  for (std::size_t z = 0; z < n * n; ++z)
    by_value[0][z] = flux[z / n].slope[z % n], by_value[1][z] = flux[z / n].slope[z % n + n];
  for (std::size_t side = 0; side < 2; ++side) {
    const double weight = correction_weight(in.end[side]);
    if (weight == 0.0) continue;
    Unknowns<double> plain, further;
    Unknowns<One> along;  // the whole step that the flux is linear in
    for (std::size_t k = 0; k < n; ++k) {
      plain[k] = sides[side].value[k].value, further[k] = sides[side].further[k].value;
      along[k].value = in.q[side][k], along[k].slope[0] = plain[k] - in.q[side][k] + further[k];
    }
    const auto above = extrapolation_correction<double>(in.q[side], plain, further, in.normal);
    const auto at_vertex = flux_derivative<One>(along, normal);
    const Block at_value = flux_derivative<double>(plain, normal);
    for (std::size_t z = 0; z < n * n; ++z) {
      result.by_state[side][z] += weight * part.value * at_vertex[z].slope[0];
      by_value[side][z] += weight * part.value * (at_vertex[z].value - at_value[z]);
      by_further[side][z] = weight * part.value * at_vertex[z].value;
      for (std::size_t end = 0; end < 2; ++end)
        result.by_state[end][z] += weight * above[z / n] * part.slope[z % n + n * end];
    }
  }
  Fluxes<double> by_limited = {};
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t z = 0; z < n * n; ++z) {
      const Four &value_of_side = sides[side].value[z % n], &further = sides[side].further[z % n];
      std::array<double, 4> by;
      for (std::size_t i = 0; i < 4; ++i)
        by[i] = by_value[side][z] * value_of_side.slope[i] + by_further[side][z] * further.slope[i];
      result.by_state[0][z] += by[0], result.by_state[1][z] += by[1], result.by_along[side][z] = by[2];
      by_limited[z / n] += by[3];
    }
  if (limited == 0.0) return result;
  const Both part_limited = limited_part<Both>(q[0], q[1]);
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t z = 0; z < n * n; ++z)
      result.by_state[side][z] += by_limited[z / n] * part_limited.slope[z % n + n * side];
  return result;
}

}  // namespace remodel::flow
