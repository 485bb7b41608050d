#pragma once

// A wall that a gas with friction sticks to: the flux is the pressure's, and the rows of momentum (of the
// turbulence, and of energy where the wall has a temperature) at its vertices are replaced,
// scheme/friction_system.h. Its edges are not bent: cells beside it may be lower than it bulges.

#include "flow/physics/boundary/slip_wall.h"

namespace remodel::flow {

struct NoSlipWall {
  static constexpr const char* kind = "wall";
  static constexpr bool solid = true, bent = false, one_sided = true, open = false;
  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream& stream) const {
    return SlipWall{}.flux(in, stream);
  }
};

}  // namespace remodel::flow
