#pragma once

// Gas leaves against a given pressure. Source: J.-R. Carlson, "Inflow/outflow boundary conditions with
// application to FUN3D", NASA TM-2011-217181.

#include "flow/physics/boundary/inputs.h"

namespace remodel::flow {

struct Outlet {
  static constexpr const char* kind = "inlet or outlet";
  static constexpr bool solid = false, bent = false, one_sided = false, open = true;
  double given = 1.0;  // the pressure, a part of the stream's

  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream&) const {
    const Unknowns<T> at = state(in);
    return roe_flux<T>(at, at, in.half);  // of one state: its own flux
  }

 private:
  // Entropy, the speed along the boundary and the wave that leaves are the inner state's. Gas that leaves
  // faster than sound is the inner state; a pressure that would make gas do so at the outlet itself counts as
  // the one at the speed of sound.
  template <class T>
  Unknowns<T> state(const BoundaryInputs<T>& in) const {
    using std::pow, std::sqrt;
    constexpr double g = gas_gamma - 1.0;
    const Unknowns<T> inside = in.mean();
    const auto [nx, ny] = in.unit_normal();
    const T &rho = density(inside), &u = velocity_x(inside), &v = velocity_y(inside), &p = pressure(inside);
    const T c = sqrt(gas_gamma * p / rho), speed = u * nx + v * ny;
    if (value_of(speed) >= value_of(c)) return inside;
    const T sonic_c = (g * speed + 2.0 * c) / (g + 2.0);
    T there = T(given / gas_gamma);
    if (value_of(sonic_c) > 0.0) {
      const T sonic = p * pow(sonic_c / c, 2.0 * gas_gamma / g);
      if (value_of(sonic) > value_of(there)) there = sonic;
    }
    const T outer_density = rho * pow(there / p, 1.0 / gas_gamma);
    const T gain = (2.0 / g) * (c - sqrt(gas_gamma * there / outer_density));
    return {outer_density, u + nx * gain, v + ny * gain, there};
  }
};

}  // namespace remodel::flow
