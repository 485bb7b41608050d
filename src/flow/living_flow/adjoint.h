#pragma once

// The discrete adjoint: derivatives of functions of a flow by everything that the flow follows, at the cost
// of one linear system for each function, however many parameters there are. Source: M. B. Giles and N. A.
// Pierce, "An introduction to the adjoint approach to design", Flow, Turbulence and Combustion 65 (2000),
// section 2.
//
// A flow solves F(x, p) = 0. x are the states at all vertices and the augmented unknowns: strength of the far
// field's vortex, angle of attack (linear/augmented.h). p are the places of all points of the mesh, Mach
// number and the condition: the angle, or the lift that is given. A function J(x, p) follows p directly and
// by x:
//
//   dJ/dp = J_p + J_x dx/dp,   F_x dx/dp = -F_p   =>   dJ/dp = J_p - L F_p,   L F_x = J_x.
//
// Step by step:
//
//   1. F_x is the Jacobian of Newton's method, without pseudo-time: the same matrix, so that the adjoint is
//      that of the equations that were solved (limiter included), not of the continuous ones. Its faces'
//      derivatives are kept for 4.
//   2. J_x and J_p come from scheme/functional.h, by dual numbers.
//   3. The transposed system is solved by GMRES (Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7
//      (1986)), preconditioned by the transpose of what Preconditioner (search/chord.h) does: the factors of
//      an earlier matrix and, in the zone where the mesh has changed since, an exact solve with the present
//      one. In the transpose the zone comes first. The two augmented unknowns are eliminated: A^-1 B is
//      known, what is left is a system of two. The solution of the last design is the first guess.
//   4. L F_p is never made of a matrix: scheme/shape_derivative.cpp and friction_slopes.h walk the terms once for
//      all functions, and sum what each face's geometry contributes, weighted by L.
//   5. The limiter's length is the distance of two vertices, the lift's equation sees the walls: both are
//      added (euler_gradients.cpp). With friction rows of walls that say "the gas stands still" follow no place;
//      the momentum that is left unbalanced there is the force of friction (friction_gradients.cpp).
//
// What comes out are derivatives by points of the mesh. MeshDerivative (remodel/mesh_derivative.h) and
// InteriorDisplacement take them to the parameters of a design.
//
// Accuracy: the residual of 3 is the flow's tolerance, within 1e-12 and 1e-8 of the right side. The scheme
// has derivatives everywhere but where a limiter's branch changes; tests compare with differences of whole
// flows (adjoint_test.cpp).

#include <span>

#include "flow/linear/factors.h"
#include "flow/linear/overlap.h"
#include "flow/scheme/block_system.h"
#include "remodel/flow.h"

namespace remodel::flow {

// Compiled for blocks of N = 4 and 5.
template <std::size_t N>
class Adjoint {
 public:
  // `matrix`: the Jacobian at the state, without pseudo-time.
  Adjoint(const BlockSystem<N>& system, const BlockState<N>& state, const BlockMatrix<N>& matrix,
          BlockFactors<N>& factors, const Overlap& overlap, const FlowOptions& options);
  // L for each of these J_x. False where the factors do not serve, or where that takes more than `most_solves` with
  // them, for all functions together. multipliers: a guess for each function, or one that is empty; the solutions
  // come to lie there.
  bool solve(std::span<const BlockIncrement<N>> functions, std::vector<BlockIncrement<N>>& multipliers,
             double most_solves, int& iterations);

 private:
  bool solve(const BlockIncrement<N>& right, double most_solves, BlockIncrement<N>& guess, int& iterations);
  void precondition(BlockIncrement<N>& x);
  void precondition_vertices(BlockVector<N>& x);

  BlockAugmentedMatrix<N> matrix_;
  BlockFactors<N>& factors_;
  const Overlap& overlap_;
  const FlowOptions& options_;
  BlockMatrix<N> zone_;
  DirectSolver<N> zone_lu_;
  std::array<BlockVector<N>, augmented_count> columns_;  // A^-1 B, of the earlier matrix
  std::array<Augmented, augmented_count> small_;         // E^T - (A^-1 B)^T C^T
  bool ready_ = true;
};

}  // namespace remodel::flow
