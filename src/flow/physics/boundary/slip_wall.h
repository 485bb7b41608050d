#pragma once

// A wall that the flow slips along, weakly: the flux is the pressure's. Source: H. Nishikawa, J. Comput.
// Phys. 281 (2015), section 3.

#include "flow/physics/boundary/inputs.h"

namespace remodel::flow {

// The force of these pressures on the half: exact to second order where pressure is linear and the curvature
// even. The half turns away from the edge (wall_bulge.h) with the pressure of its middle.
template <class T>
PlaneVector<T> wall_force(const BoundaryInputs<T>& in, const T& here, const T& there) {
  const T middle = near_place * here + far_place * there;
  const T beyond = (in.near - near_place) * 0.5 * (here - there);
  return {middle * in.half.x + beyond * in.normal.x, middle * in.half.y + beyond * in.normal.y};
}

struct SlipWall {
  static constexpr const char* kind = "wall";
  static constexpr bool solid = true, bent = true, one_sided = true, open = false;
  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream&) const {
    const PlaneVector<T> force = wall_force(in, pressure(in.here), pressure(in.there));
    return {T(0.0), force.x, force.y, T(0.0)};
  }
};

}  // namespace remodel::flow
