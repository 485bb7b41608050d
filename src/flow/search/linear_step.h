#pragma once

// The linear system of one Newton step: solved by whole factors, or with incomplete ones by GMRES, as far as
// an inexact Newton method needs it (R. S. Dembo, S. C. Eisenstat and T. Steihaug, SIAM J. Numer. Anal. 19
// (1982)).

#include "flow/linear/factors.h"
#include "flow/scheme/flow_system.h"
#include "remodel/mesh.h"

namespace remodel::flow {

struct LinearStep {
  Increment step;
  double left = 0.0;  // of the residual, as a part of it; 0 by whole factors
  int iterations = 0;
  bool solved = true;  // as far as was asked for
};

// The matrix at a state, its factors, and minus the residuals. `part`: of the residual that may be left;
// `observer` ends GMRES, whose step is not solved then.
LinearStep linear_step(const FlowSystem& system, const State& state, const BlockRows& matrix,
                       Factors& factors, Increment right, double part, StepObserver* observer);

}  // namespace remodel::flow
