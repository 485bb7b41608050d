#pragma once

// Sparse LU of a block matrix, by MUMPS (direct_solver.cpp) or by Eigen (direct_solver_eigen.cpp), in single
// precision: half the memory, and a solve takes the time of reading the factors. All that solve with them
// correct their steps by residuals in double precision. Calls from several threads are safe: MUMPS, which
// keeps state of its own, takes them in turn.

#include <memory>
#include <span>

#include "flow/linear/block_matrix.h"

namespace remodel::flow {

enum class Factored { done, out_of_memory, singular };

// Compiled for blocks of N = 4 and 5.
template <std::size_t N>
class DirectSolver {
 public:
  DirectSolver();
  ~DirectSolver();
  DirectSolver(DirectSolver&&) noexcept;
  DirectSolver& operator=(DirectSolver&&) noexcept;

  // A square matrix: columns outside its rows are left out. The ordering is kept from the last call where the
  // pattern is the same. memory_mb: what the factorisation may take; where an estimate says that it takes
  // more, no factors are made.
  Factored factor(const BlockMatrix<N>& matrix, double memory_mb);
  bool ready() const;
  void forget();

  // In place, `count` right-hand sides after each other, in the order of the matrix's rows. Single precision.
  void solve(std::span<std::array<double, N>> right, std::size_t count);

  // The same with the transposed matrix.
  void solve_transposed(std::span<std::array<double, N>> right, std::size_t count);

  double memory_mb() const;  // of the last factorisation
  // Counted work, in units of one multiplication that waits for memory: the same for the same matrix.
  double factor_work() const;
  double solve_work() const;  // of one right-hand side

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace remodel::flow
