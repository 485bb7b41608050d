#pragma once

// GMRES for augmented systems, preconditioned from the right, so that the residual is that of the system
// itself. Sources: Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986); it keeps the
// preconditioned vectors too, as Y. Saad's flexible one does (SIAM J. Sci. Comput. 14 (1993)).

#include <functional>
#include <limits>

#include "flow/linear/augmented.h"
#include "remodel/mesh.h"

namespace remodel::flow {

struct GmresLimits {
  double wanted;  // the residual to end at
  int restart;    // steps before it begins anew, and how often it does so
  int rounds;
  double most_iterations = std::numeric_limits<double>::infinity();  // in all
  StepObserver* observer = nullptr;                                  // asked at each
};

struct GmresEnd {
  double residual;  // of the system, computed afresh
  int iterations;
  bool in_time = true;  // false: most_iterations or the observer ended it, and `x` is the last round's
};

// From x where that is better than nothing; it becomes the solution. `times` is the system's matrix,
// `precondition` about its inverse, in place.
template <std::size_t N>
GmresEnd gmres_of(const std::function<BlockIncrement<N>(const BlockIncrement<N>&)>& times,
                  const std::function<void(BlockIncrement<N>&)>& precondition, const BlockIncrement<N>& right,
                  const GmresLimits& limits, BlockIncrement<N>& x);
inline GmresEnd gmres(const std::function<Increment(const Increment&)>& times,
                      const std::function<void(Increment&)>& precondition, const Increment& right,
                      const GmresLimits& limits, Increment& x) {
  return gmres_of<unknown_count>(times, precondition, right, limits, x);
}

// What each step before a new beginning takes, for each vertex of so many unknowns.
inline constexpr double gmres_bytes_of(std::size_t unknowns) {
  return 2.0 * sizeof(double) * static_cast<double>(unknowns);
}
inline constexpr double gmres_bytes = gmres_bytes_of(unknown_count);

}  // namespace remodel::flow
