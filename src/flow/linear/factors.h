#pragma once

// What solves with a Jacobian: its LU, or an incomplete one, with which GMRES solves: where it is solved with
// but once, or where LU needs more memory than is given.

#include <limits>

#include "flow/linear/augmented.h"
#include "flow/linear/direct_solver.h"
#include "flow/linear/incomplete_lu.h"

namespace remodel::flow {

// What a matrix is factored for: many solves, or the one of a step with GMRES.
enum class FactorKind { whole, incomplete };

// Compiled for blocks of N = 4 and 5.
template <std::size_t N>
class BlockFactors {
 public:
  // Level 2 takes the least time with the exact Jacobian (docs/flow.md, "Memory").
  explicit BlockFactors(int highest_level = 2) : highest_level_(highest_level) {}

  // Whole factors if memory_mb, the same in all calls, has room for them; otherwise, or if they are asked
  // for, incomplete ones of the highest level of fill that leaves room for the vectors of GMRES.
  // `augmented`: the two columns beside the matrix, which are solved for.
  Factored factor(const BlockMatrix<N>& matrix, std::array<BlockVector<N>, augmented_count> augmented,
                  FactorKind kind, double memory_mb);
  // Whether whole factors of so many vertices are known to need more memory.
  bool too_large(std::size_t vertices) const { return vertices >= too_large_; }
  bool ready() const { return lu_.ready() || incomplete_.ready(); }
  bool whole() const { return lu_.ready(); }

  // In place, one right-hand side in the order of the matrix's rows: the solution, or with incomplete factors
  // about that.
  void solve(BlockVector<N>& right);
  void solve_transposed(BlockVector<N>& right);
  // Of the augmented, solved.
  const std::array<BlockVector<N>, augmented_count>& columns() const { return columns_; }

  int restart() const { return restart_; }  // of GMRES: what there is room for
  double memory_mb() const;                 // of the factors and, where they are incomplete, GMRES's vectors
  // As DirectSolver counts.
  double factor_work() const;
  double solve_work() const;

 private:
  Factored factor_incompletely(const BlockMatrix<N>& matrix, double memory_mb);

  DirectSolver<N> lu_;
  IncompleteLu<N> incomplete_;
  // Meshes of so many vertices and more have been found to need more memory.
  std::size_t too_large_ = std::numeric_limits<std::size_t>::max();
  int highest_level_, restart_ = 0;
  std::array<BlockVector<N>, augmented_count> columns_;
};
using Factors = BlockFactors<unknown_count>;

}  // namespace remodel::flow
