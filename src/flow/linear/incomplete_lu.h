#pragma once

// Incomplete LU of a block matrix by level of fill, ILU(k): what elimination adds is kept where it stems from
// entries of the matrix by at most k steps. Source: Y. Saad, "Iterative Methods for Sparse Linear Systems",
// SIAM, 2nd edition (2003), section 10.3; rows in reverse order of E. Cuthill and J. McKee, Proc. 24th ACM
// National Conference (1969). The factors are in single precision: they are off by far more than its
// rounding.

#include <span>

#include "flow/linear/block_matrix.h"

namespace remodel::flow {

// Compiled for blocks of N = 4 and 5.
template <std::size_t N>
class IncompleteLu {
 public:
  // What factors of this level are going to take, of a square matrix whose rows are all vertices, in order.
  // Their pattern is kept from the last call where the matrix's and the level are the same.
  double analysed_mb(const BlockMatrix<N>& matrix, int level);
  // Requires a matrix of the pattern that was analysed. False: a pivot is singular.
  bool factor(const BlockMatrix<N>& matrix);
  bool ready() const { return ready_; }
  bool is_of(const BlockMatrix<N>& matrix) const {  // of its pattern
    return level_ >= 0 && matrix_start_ == matrix.start && matrix_column_ == matrix.column;
  }
  int level() const { return level_; }
  void forget() { *this = {}; }

  // In place, about the matrix's inverse, or the inverse's transpose, times a vector.
  void solve(std::span<std::array<double, N>> x) const;
  void solve_transposed(std::span<std::array<double, N>> x) const;

  double memory_mb() const;
  std::size_t blocks() const { return column_.size(); }

 private:
  using SmallBlock = std::array<float, N * N>;
  void order(const BlockMatrix<N>& matrix);
  void fill_pattern(const BlockMatrix<N>& matrix, int level);

  std::vector<std::uint32_t> matrix_start_, matrix_column_;  // of the pattern that was analysed
  int level_ = -1;
  std::vector<std::uint32_t> row_at_,
      place_of_;  // the matrix's row at each place of the factors; its inverse
  std::vector<std::uint32_t> start_, diagonal_, column_;  // of L and U together, in places
  std::vector<SmallBlock> block_;                         // L, whose own diagonal is 1; inverse diagonal; U
  bool ready_ = false;
};

}  // namespace remodel::flow
