#pragma once

// Vectors and matrices of a flow's unknowns: blocks of vertices, and two unknowns beside them. The augmented
// system [A B; D E] [x; z] = [r; g] has B dense and D sparse, and is solved by what solves for A alone.

#include <array>
#include <span>
#include <vector>

#include "flow/linear/block_matrix.h"
#include "flow/physics/state.h"

namespace remodel::flow {

inline constexpr std::size_t augmented_count = 2;
using Augmented = std::array<double, augmented_count>;

// All that follows is compiled for blocks of N = 4 and 5.
template <std::size_t N>
struct BlockIncrement {
  BlockVector<N> q;
  Augmented augmented = {};
};

template <std::size_t N>
BlockIncrement<N> zero_of(std::size_t vertices) {
  return {.q = BlockVector<N>(vertices), .augmented = {}};
}
template <std::size_t N>
double inner(const std::vector<std::array<double, N>>& a, const std::vector<std::array<double, N>>& b);
template <std::size_t N>
double inner(const BlockIncrement<N>& a, const BlockIncrement<N>& b);
template <std::size_t N>
double norm(const BlockIncrement<N>& a);
template <std::size_t N>
void add_times(BlockIncrement<N>& to, double factor, const BlockIncrement<N>& what);

// What flows are found for: the unknowns of vertices and the augmented ones, which in src/flow are the lift coefficient
// that the far field's vortex belongs to and the angle of attack in radians.
template <std::size_t N>
struct BlockState {
  BlockVector<N> q;
  Augmented augmented = {};
};

// D and E. The second equation has augmented unknowns alone.
template <std::size_t N>
struct BlockAugmentedRows {
  struct Entry {
    std::uint32_t vertex;
    std::array<double, N> by;
  };
  std::vector<Entry> first;  // a vertex may have several
  std::array<Augmented, augmented_count> corner;

  double times(const BlockVector<N>& x) const;                   // the first row of D
  void add_transposed(double factor, BlockVector<N>& to) const;  // of it
};

// The whole matrix.
template <std::size_t N>
class BlockAugmentedMatrix {
 public:
  BlockAugmentedMatrix(const BlockMatrix<N>& matrix, std::array<BlockVector<N>, augmented_count> columns,
                       BlockAugmentedRows<N> rows)
      : matrix_(matrix), columns_(std::move(columns)), rows_(std::move(rows)) {}
  const BlockMatrix<N>& blocks() const { return matrix_; }
  const BlockAugmentedRows<N>& rows() const { return rows_; }
  BlockIncrement<N> times(const BlockIncrement<N>& x) const;
  BlockIncrement<N> transposed_times(const BlockIncrement<N>& x) const;

 private:
  const BlockMatrix<N>& matrix_;
  std::array<BlockVector<N>, augmented_count> columns_;
  BlockAugmentedRows<N> rows_;
};

// x and the solutions y of A y = B for both columns. Not finite where the small system is singular.
template <std::size_t N>
BlockIncrement<N> close_augmented(std::vector<std::array<double, N>> x,
                                  const std::array<std::vector<std::array<double, N>>, augmented_count>& y,
                                  const BlockAugmentedRows<N>& rows, const Augmented& right);

// Those of the Euler equations.
using Vector = BlockVector<unknown_count>;
using Block = SquareBlock<unknown_count>;
using BlockRows = BlockMatrix<unknown_count>;
using State = BlockState<unknown_count>;
using Increment = BlockIncrement<unknown_count>;
using AugmentedRows = BlockAugmentedRows<unknown_count>;
using AugmentedMatrix = BlockAugmentedMatrix<unknown_count>;
inline Increment zero(std::size_t vertices) {
  return zero_of<unknown_count>(vertices);
}

}  // namespace remodel::flow
