#pragma once

// On which side of a loop's direction the domain lies.

#include <optional>

#include "remodel/domain.h"

namespace remodel {

// Whether it lies to the left; nothing: on both sides.
inline std::optional<bool> has_domain_on_left(const Domain& domain, std::size_t loop) {
  switch (domain.loops[loop].role) {
    case LoopRole::outer:
      return signed_area(domain, loop) > 0.0;
    case LoopRole::hole:
      return signed_area(domain, loop) < 0.0;
    case LoopRole::left:
      return true;
    case LoopRole::right:
      return false;
    case LoopRole::internal:
      break;
  }
  return std::nullopt;
}

}  // namespace remodel
