#pragma once

// Block matrices times vectors, slowly, and what tests of solvers compare.

#include <algorithm>
#include <cmath>
#include <random>

#include "flow/linear/block_matrix.h"

namespace remodel::flow {

// The matrix, or its transpose, times x; columns outside the rows are left out.
template <std::size_t N>
BlockVector<N> product(const BlockMatrix<N>& matrix, const BlockVector<N>& x, bool transposed) {
  BlockVector<N> y(x.size());
  for (std::size_t r = 0; r < matrix.rows.size(); ++r)
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const auto at = std::find(matrix.rows.begin(), matrix.rows.end(), matrix.column[i]);
      if (at == matrix.rows.end()) continue;
      const auto c = static_cast<std::size_t>(at - matrix.rows.begin());
      for (std::size_t j = 0; j < N; ++j)
        for (std::size_t k = 0; k < N; ++k)
          (transposed ? y[c][k] : y[r][j]) += matrix.block[i][N * j + k] * (transposed ? x[r][j] : x[c][k]);
    }
  return y;
}

template <std::size_t N>
BlockVector<N> random_vector(std::size_t size, std::mt19937& random) {
  std::normal_distribution<double> entry;
  BlockVector<N> x(size);
  for (auto& values : x)
    for (double& value : values) value = entry(random);
  return x;
}

template <std::size_t N>
double distance(const BlockVector<N>& a, const BlockVector<N>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) largest = std::max(largest, std::fabs(a[i][k] - b[i][k]));
  return largest;
}

}  // namespace remodel::flow
