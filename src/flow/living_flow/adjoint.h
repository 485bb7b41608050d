#pragma once

// The discrete adjoint of the augmented flow equations. With F(x, p) = 0 for the flow x (states and
// augmented) and parameters p, a function J has dJ/dp = J_p - L F_p, where L solves the transposed system L
// F_x = J_x. Source: M. B. Giles and N. A. Pierce, "An introduction to the adjoint approach to design", Flow,
// Turbulence and Combustion 65 (2000), section 2.

#include <optional>
#include <span>

#include "flow/search/newton_search.h"

namespace remodel::flow {

// Where a mesh differs from the one that factors belong to.
struct Overlap {
  std::vector<std::uint32_t> row_of;  // per vertex its row in the factors, no_index if it has none
  std::size_t rows = 0;               // of the factors
  std::vector<std::uint32_t> zone;    // vertices with other neighbours and two rings around them, ascending
};

// The transposed augmented Jacobian [A B; C E] at a state.
class TransposedSystem {
 public:
  TransposedSystem(const FlowSystem& system, const State& state, const BlockRows& matrix)
      : matrix_(matrix), columns_(system.augmented_columns(state)), rows_(system.augmented_rows(state)) {}
  Increment times(const Increment& x) const;
  const BlockRows& matrix() const { return matrix_; }
  const FlowSystem::AugmentedRows& augmented_rows() const { return rows_; }

 private:
  const BlockRows& matrix_;  // A
  std::array<Vector, 2> columns_;
  FlowSystem::AugmentedRows rows_;
};

// About its inverse: the transposed factors of an earlier Jacobian and, in the zone, an exact solve with the
// present one, closed by the augmented. It is the transpose of what Preconditioner (chord.h) does.
class TransposedInverse {
 public:
  TransposedInverse(const TransposedSystem& system, Factors& factors, const Overlap& overlap,
                    double memory_mb);
  bool ready() const { return ready_; }
  const Factors& factors() const { return factors_; }
  void apply(Increment& x);

 private:
  void apply_to_vertices(Vector& x);

  const FlowSystem::AugmentedRows& rows_;
  Factors& factors_;
  const Overlap& overlap_;
  BlockRows zone_;
  DirectSolver zone_lu_;
  std::array<Vector, 2> columns_;               // A^-1 B, of the earlier matrix
  std::array<std::array<double, 2>, 2> small_;  // E^T - (A^-1 B)^T C^T
  bool ready_ = true;
};

// When a solve ends.
struct TransposedLimits {
  double tolerance;    // of the residual, in parts of the right-hand side
  double most_solves;  // with the factors
  StepObserver* observer;
};

// Solves to within the tolerance by GMRES (Y. Saad and M. H. Schultz, SIAM J.
// Sci. Stat. Comput. 7 (1986)), from `guess` where that is better than nothing; the solution comes to lie in
// `guess`. False where it takes too long, as the factors are too old then, or is interrupted.
bool solve_transposed(const TransposedSystem& system, TransposedInverse& inverse, const Increment& right,
                      const TransposedLimits& limits, Increment& guess, int& iterations);

// Derivatives of a function of the flow, which follows the parameters.
struct Total {
  ShapeSlope shape;
  double condition = 0.0;  // by the angle of attack, a radian; where lift is given, by the lift
};

// The derivatives of these functions. None where the factors do not serve, or where that takes more than
// `most_solves` with them, for all functions together. multipliers: a guess for each function, or one that is
// empty; the solutions come to lie there.
std::optional<std::vector<Total>> totals(const FlowSystem& system, const State& state,
                                         const BlockRows& matrix, Factors& factors, const Overlap& overlap,
                                         const FlowOptions& options, std::span<const ForceSlope> functions,
                                         std::vector<Increment>& multipliers, double most_solves,
                                         int& iterations);

}  // namespace remodel::flow
