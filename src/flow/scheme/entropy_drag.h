#pragma once

// The drag that entropy makes: the momentum that gas would lack which leaves by the far field, had it
// expanded to the stream's pressure with the stream's total enthalpy. It is the drag by another way: without
// friction there is none but by entropy, be it a shock's or the scheme's. Source: D. Destarac and J. van der
// Vooren, "Drag/thrust analysis of jet-propelled transonic transport aircraft", Aerosp. Sci. Technol. 8
// (2004).

#include "flow/scheme/functional.h"

namespace remodel::flow {

struct EntropyDrag {
  static constexpr std::size_t sums = 1;  // the momentum
  bool includes(const FlowMesh& mesh, std::uint32_t patch) const {
    return mesh.patches()[patch].is_farfield();
  }
  template <class T>
  std::array<T, sums> local(const BoundaryInputs<T>& in, const Stream&) const {
    using std::pow, std::sqrt;
    const Unknowns<T> q = in.mean();
    const T mass = density(q) * (velocity_x(q) * in.half.x + velocity_y(q) * in.half.y);
    // Over that of the stream, whose speed of sound is 1: the temperature at the stream's pressure.
    const T temperature = pow(gas_gamma * pressure(q) / pow(density(q), gas_gamma), 1.0 / gas_gamma);
    const T square = in.mach * in.mach - 2.0 / (gas_gamma - 1.0) * (temperature - 1.0);
    if (!(value_of(square) > 0.0)) return {mass * in.mach};  // it could not leave
    return {mass * (in.mach - sqrt(square))};
  }
  template <class T>
  T total(const std::array<T, sums>& of, const T& mach, const T&, const Stream& stream) const {
    return of[0] / (0.5 * mach * mach * stream.length);
  }
};

}  // namespace remodel::flow
