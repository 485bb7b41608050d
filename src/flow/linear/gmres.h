#pragma once

// GMRES for augmented systems, preconditioned from the right, so that the residual is that of the system
// itself. Source: Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986). It keeps the first
// preconditioned vectors too, which spares a short solution by whole factors a solve; of the others their sum
// is preconditioned once more.

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

// Its vectors: one for each step before a new beginning, and the preconditioned ones that it keeps.
inline constexpr int gmres_kept = 8;
inline constexpr double gmres_vector_mb(std::size_t unknowns, std::size_t vertices) {
  return 1e-6 * static_cast<double>(sizeof(double) * unknowns * vertices);
}

}  // namespace remodel::flow
