#pragma once

// A straight line along the stream beyond which the flow is its own mirror image: nothing passes it, and its
// pressure is no force on a body.

#include "flow/physics/boundary/slip_wall.h"

namespace remodel::flow {

struct Symmetry {
  static constexpr const char* kind = "symmetry plane";
  static constexpr bool solid = false, bent = false, one_sided = true, open = false;
  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream& stream) const {
    return SlipWall{}.flux(in, stream);
  }
};

}  // namespace remodel::flow
