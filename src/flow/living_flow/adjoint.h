#pragma once

// The discrete adjoint. With F(x, p) = 0 for the flow x (states and augmented unknowns) and parameters p, a
// function J has dJ/dp = J_p - L F_p, where L solves the transposed system L F_x = J_x. Source: M. B. Giles
// and N. A. Pierce, "An introduction to the adjoint approach to design", Flow, Turbulence and Combustion 65
// (2000), section 2.
//
// The transposed system is solved by GMRES (Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986)),
// preconditioned by the transpose of what Preconditioner (search/chord.h) does: the factors of an earlier
// matrix and, in the zone where the mesh has changed since, an exact solve with the present one.

#include <optional>
#include <span>

#include "flow/linear/factors.h"
#include "flow/linear/overlap.h"
#include "flow/scheme/functional.h"
#include "remodel/flow.h"

namespace remodel::flow {

// Derivatives of a function of the flow, which follows the parameters.
struct Total {
  ShapeSlope shape;
  double condition = 0.0;  // by the angle of attack, a radian; where lift is given, by the lift
};

class Adjoint {
 public:
  // `matrix`: the Jacobian at the state, without pseudo-time, and what it was made of.
  Adjoint(const FlowSystem& system, const State& state, const BlockRows& matrix,
          std::span<const FaceDerivative> faces, Factors& factors, const Overlap& overlap,
          const FlowOptions& options);
  // The derivatives of these functions. None where the factors do not serve, or where that takes more than
  // `most_solves` with them, for all functions together. multipliers: a guess for each function, or one that
  // is empty; the solutions come to lie there.
  std::optional<std::vector<Total>> totals(std::span<const FunctionalSlope> functions,
                                           std::vector<Increment>& multipliers, double most_solves,
                                           int& iterations);

 private:
  bool solve(const Increment& right, double most_solves, Increment& guess, int& iterations);
  void precondition(Increment& x);
  void precondition_vertices(Vector& x);

  const FlowSystem& system_;
  const State& state_;
  AugmentedMatrix matrix_;
  std::span<const FaceDerivative> faces_;
  Factors& factors_;
  const Overlap& overlap_;
  const FlowOptions& options_;
  BlockRows zone_;
  DirectSolver<unknown_count> zone_lu_;
  std::array<Vector, augmented_count> columns_;   // A^-1 B, of the earlier matrix
  std::array<Augmented, augmented_count> small_;  // E^T - (A^-1 B)^T C^T
  bool ready_ = true;
};

}  // namespace remodel::flow
