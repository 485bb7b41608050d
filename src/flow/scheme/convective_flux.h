#pragma once

// The convective flux: Roe's, of values reconstructed along the edge, moved towards the mean of fluxes
// linearised at the vertices.

#include "flow/scheme/face.h"

namespace remodel::flow {

struct ConvectiveFlux {
  double limiter;  // Stream::limiter
  double slopes;   // Stream::slopes

  template <class Q, class G>
  Fluxes<std::common_type_t<Q, G>> flux(const FaceInputs<Q, G>& in) const {
    using T = std::common_type_t<Q, G>;
    using std::sqrt;
    const G h = limiter * sqrt(in.edge.x * in.edge.x + in.edge.y * in.edge.y) / in.length;
    const G epsilon = h * h * h;
    const Q limited = limited_part<Q>(in.q[0], in.q[1]);
    Unknowns<T> value[2], further[2];
    for (std::size_t k = 0; k < unknown_count; ++k) {
      const Q central = in.q[1][k] - in.q[0][k];
      for (std::size_t side = 0; side < 2; ++side) {
        const ReconstructionStep<T> to =
            reconstruction_step<T, Q>(in.end[side], 2.0 * in.along[side][k] - central, central, epsilon, limited);
        const double direction = side == 0 ? slopes : -slopes;
        value[side][k] = in.q[side][k] + direction * to.step, further[side][k] = direction * to.further;
      }
    }
    for (const std::size_t k : positive_unknowns)
      for (std::size_t side = 0; side < 2; ++side)
        value[side][k] = positivity_limited(value[side][k], in.q[side][k]);
    Fluxes<T> result = roe_flux<T>(value[0], value[1], in.normal);
    const Fluxes<T> above[2] = {extrapolation_correction<T>(in.q[0], value[0], further[0], in.normal),
                                extrapolation_correction<T>(in.q[1], value[1], further[1], in.normal)};
    const Q part = smoothness<Q>(in.q[0], in.q[1]);
    const double weight[2] = {correction_weight(in.end[0]), correction_weight(in.end[1])};
    for (std::size_t k = 0; k < unknown_count; ++k)
      result[k] = result[k] + part * (weight[0] * above[0][k] + weight[1] * above[1][k]);
    return result;
  }

  // Written by hand: general_derivative() gives the same in two to three times the time (docs/flow.md).
  FaceDerivative derivative(const FaceInputs<double, double>& in) const;
};

}  // namespace remodel::flow
