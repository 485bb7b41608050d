#pragma once

// The terms of the equations. Each is one function template over local inputs, `flux`: those here of both
// ends of a face, boundary conditions (physics/boundary/patch.h) of the half of a boundary edge. Three
// drivers walk all of them: residual.cpp with numbers, jacobian.cpp with derivatives by local unknowns, and
// shape_derivative.cpp with derivatives by local places. A term may have its `derivative` by local unknowns
// written by hand.

#include <tuple>

#include "flow/scheme/convective_flux.h"

namespace remodel::flow {

using FaceTerms = std::tuple<ConvectiveFlux>;

inline FaceTerms terms_of(const Stream& stream) {
  return {ConvectiveFlux{.limiter = stream.limiter, .slopes = stream.slopes}};
}

template <class Q, class G>
auto flux_of(const FaceTerms& terms, const FaceInputs<Q, G>& in) {
  auto sum = std::get<0>(terms).flux(in);
  const auto add = [&](const auto& term) {
    const auto flux = term.flux(in);
    for (std::size_t k = 0; k < unknown_count; ++k) sum[k] = sum[k] + flux[k];
  };
  std::apply([&](const auto&, const auto&... others) { (add(others), ...); }, terms);
  return sum;
}

inline FaceDerivative derivative_of(const FaceTerms& terms, const FaceInputs<double, double>& in) {
  const auto derivative = [&](const auto& term) {
    if constexpr (requires { term.derivative(in); })
      return term.derivative(in);
    else
      return general_derivative(term, in);
  };
  FaceDerivative sum = derivative(std::get<0>(terms));
  const auto add = [&](const auto& term) {
    const FaceDerivative one = derivative(term);
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t z = 0; z < sum.by_state[side].size(); ++z)
        sum.by_state[side][z] += one.by_state[side][z], sum.by_along[side][z] += one.by_along[side][z];
  };
  std::apply([&](const auto&, const auto&... others) { (add(others), ...); }, terms);
  return sum;
}

}  // namespace remodel::flow
