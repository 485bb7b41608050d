#pragma once

// The discrete adjoint of the bordered Euler equations. With F(x, p) = 0 for the flow x (states and border)
// and parameters p, a function J has dJ/dp = J_p - L F_p, where L solves the transposed system L F_x = J_x.
// Source: M. B. Giles and N. A. Pierce, "An introduction to the adjoint approach to design", Flow, Turbulence
// and Combustion 65 (2000), section 2.

#include <optional>

#include "flow/newton.h"

namespace remodel::flow {

// Solves with the transposed Jacobian `matrix`: by GMRES with the transposed factors of an earlier one, whose
// rows are those of the same vertices (Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986)).
// False where that takes too long: the factors are too old then.
bool solve_transposed(const BlockRows& matrix, DirectSolver& factors, Vector& right, int& iterations);

// Derivatives of a function of the flow, which follows the parameters.
struct Total {
  ShapeSlope shape;
  double condition = 0.0;  // by the angle of attack, a radian; where lift is given, by the lift
};

// The transposed border, which is the same for all functions of one flow.
class Adjoint {
 public:
  // None where the factors do not serve.
  static std::optional<Adjoint> make(const Euler& euler, const State& state, const BlockRows& matrix,
                                     DirectSolver& factors, int& iterations);
  std::optional<Total> total(const ForceSlope& function, int& iterations);

 private:
  Adjoint(const Euler& euler, const State& state, const BlockRows& matrix, DirectSolver& factors)
      : euler_(euler), state_(state), matrix_(matrix), factors_(factors) {}
  const Euler& euler_;
  const State& state_;
  const BlockRows& matrix_;
  DirectSolver& factors_;
  std::array<Vector, 2> columns_;  // the border's
  Euler::BorderRows rows_;
  Vector lift_;  // the transposed matrix's solution for the derivative of lift
};

}  // namespace remodel::flow
