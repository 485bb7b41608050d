#pragma once

// One of two boundaries of which the other is the same line moved: what leaves the domain by one enters it by
// the other, as between the blades of a cascade. The mesh joins their vertices (scheme/periodic.h), so that
// no flux of its own is left.

#include <string>

#include "flow/physics/boundary/inputs.h"

namespace remodel::flow {

struct Periodic {
  static constexpr const char* kind = "periodic boundary";
  static constexpr bool solid = false, bent = false, one_sided = false, open = false;
  std::string moved;  // the name of the other one

  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>&, const Stream&) const {
    return {};
  }
};

}  // namespace remodel::flow
