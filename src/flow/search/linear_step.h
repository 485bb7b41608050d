#pragma once

// The linear system of one Newton step, [A B; D E] [x; z] = - residuals: solved by whole factors of A, or
// with incomplete ones by GMRES, as far as an inexact Newton method needs it (R. S. Dembo, S. C. Eisenstat
// and T. Steihaug, SIAM J. Numer. Anal. 19 (1982)).

#include "flow/linear/factors.h"
#include "remodel/mesh.h"

namespace remodel::flow {

struct LinearStep {
  Increment step;
  double left = 0.0;  // of the residual, as a part of it; 0 by whole factors
  int iterations = 0;
  bool solved = true;  // as far as was asked for
};

// The matrix at a state, and its factors. `part`: of the residual that may be left;
// `observer` ends GMRES, whose step is not solved then.
LinearStep linear_step(const FlowSystem& system, const State& state, const BlockRows& matrix,
                       Factors& factors, const Vector& residual, const Augmented& augmented, double part,
                       StepObserver* observer);

}  // namespace remodel::flow
