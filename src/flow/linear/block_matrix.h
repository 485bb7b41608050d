#pragma once

// Vectors and matrices of blocks: N numbers a vertex, and N x N where two vertices meet.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace remodel::flow {

template <std::size_t N>
using BlockVector = std::vector<std::array<double, N>>;

template <std::size_t N>
using SquareBlock = std::array<double, N * N>;  // row-major; rows are equations, columns unknowns

// Some rows of a matrix, ascending.
template <std::size_t N>
struct BlockMatrix {
  std::vector<std::uint32_t> rows;
  std::vector<std::uint32_t> start;   // rows.size() + 1
  std::vector<std::uint32_t> column;  // ascending in each row
  std::vector<SquareBlock<N>> block;

  // The block at this place, which the row has.
  SquareBlock<N>& at(std::size_t row, std::uint32_t of) {
    const auto begin = column.begin();
    const auto found = std::lower_bound(begin + start[row], begin + start[row + 1], of);
    return block[static_cast<std::size_t>(found - begin)];
  }
};

// to += factor * matrix * x; the r-th block of `to` belongs to the r-th row.
template <std::size_t N>
void add_product(const BlockMatrix<N>& matrix, double factor, const BlockVector<N>& x, BlockVector<N>& to) {
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    std::array<double, N> sum = to[r];
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const SquareBlock<N>& block = matrix.block[i];
      std::array<double, N> value = x[matrix.column[i]];
      for (double& entry : value) entry *= factor;
      for (std::size_t row = 0; row < N; ++row)
        for (std::size_t k = 0; k < N; ++k) sum[row] += block[N * row + k] * value[k];
    }
    to[r] = sum;
  }
}

// to += factor * matrix^T * x; the r-th block of x belongs to the r-th row.
template <std::size_t N>
void add_transposed(const BlockMatrix<N>& matrix, double factor, const BlockVector<N>& x,
                    BlockVector<N>& to) {
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    std::array<double, N> from = x[r];
    for (double& value : from) value *= factor;
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const SquareBlock<N>& block = matrix.block[i];
      std::array<double, N>& sum = to[matrix.column[i]];
      for (std::size_t row = 0; row < N; ++row)
        for (std::size_t k = 0; k < N; ++k) sum[k] += block[N * row + k] * from[row];
    }
  }
}

// Some rows of a matrix that has all.
template <std::size_t N>
BlockMatrix<N> rows_of(const BlockMatrix<N>& matrix, const std::vector<std::uint32_t>& rows) {
  BlockMatrix<N> some{.rows = rows, .start = {0}, .column = {}, .block = {}};
  for (const std::uint32_t r : rows) {
    const auto from = matrix.start[r], to = matrix.start[r + 1];
    some.column.insert(some.column.end(), matrix.column.begin() + from, matrix.column.begin() + to);
    some.block.insert(some.block.end(), matrix.block.begin() + from, matrix.block.begin() + to);
    some.start.push_back(static_cast<std::uint32_t>(some.column.size()));
  }
  return some;
}

}  // namespace remodel::flow
