#pragma once

// The stream far away. Source: J. L. Thomas and M. D. Salas, "Far-field boundary conditions for transonic
// lifting solutions to the Euler equations", AIAA J. 24 (1986), equations 3 to 6 (the compressible point
// vortex).

#include "flow/physics/boundary/inputs.h"

namespace remodel::flow {

// The stream at `from` the vortex: uniform flow of this Mach number and angle (radians), and a point vortex
// of the circulation that belongs to lift coefficient times reference length; total enthalpy and entropy are
// the stream's. The density and the speed of sound of the undisturbed stream are 1.
template <class T>
Unknowns<T> stream_around(const PlaneVector<T>& from, const T& mach, const T& alpha, const T& lift) {
  using std::cos, std::pow, std::sin, std::sqrt;
  const T ca = cos(alpha), sa = sin(alpha);
  T u = mach * ca, v = mach * sa;
  const T r2 = from.x * from.x + from.y * from.y;
  if (value_of(mach) < 1.0 && value_of(r2) > 0.0) {
    const T r = sqrt(r2);
    const T st = from.y / r, ct = from.x / r;
    const T across = st * ca - ct * sa;  // the sine of the angle to the stream
    const T speed =
        (mach * sqrt(1.0 - mach * mach) / (4.0 * M_PI * r)) * lift / (1.0 - mach * mach * across * across);
    u = u + speed * st;
    v = v - speed * ct;
  }
  const T c2 = 1.0 + 0.5 * (gas_gamma - 1.0) * (mach * mach - u * u - v * v);
  const T rho = pow(c2, 1.0 / (gas_gamma - 1.0));
  return {rho, u, v, rho * c2 / gas_gamma};
}

// Roe's flux against the stream with its vortex.
struct FarField {
  static constexpr const char* kind = "far field";
  static constexpr bool solid = false, bent = false, one_sided = false, open = false;
  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream& stream) const {
    return roe_flux<T>(in.mean(), outside(in, stream), in.half);
  }

 private:
  template <class T>
  static Unknowns<T> outside(const BoundaryInputs<T>& in, const Stream& stream) {
    const PlaneVector<T> at = in.place();
    if (stream.prescribed) return unknowns_of<T>(stream.prescribed({value_of(at.x), value_of(at.y)}));
    return stream_around<T>({at.x - stream.reference.x, at.y - stream.reference.y}, in.mach, in.alpha,
                            stream.vortex ? in.lift * stream.length : T(0.0));
  }
};

}  // namespace remodel::flow
