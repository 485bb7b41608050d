#include "flow/linear/augmented.h"

#include <cmath>

namespace remodel::flow {

// It keeps as many sums side by side as a vertex has unknowns.
template <std::size_t N>
double inner(const std::vector<std::array<double, N>>& a, const std::vector<std::array<double, N>>& b) {
  std::array<double, N> sum = {};
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < N; ++k) sum[k] += a[v][k] * b[v][k];
  double total = 0.0;
  for (std::size_t k = 0; k + 1 < N; k += 2) total += sum[k] + sum[k + 1];
  return N % 2 == 0 ? total : total + sum[N - 1];
}

template <std::size_t N>
double inner(const BlockIncrement<N>& a, const BlockIncrement<N>& b) {
  return inner(a.q, b.q) + (a.augmented[0] * b.augmented[0] + a.augmented[1] * b.augmented[1]);
}

template <std::size_t N>
double norm(const BlockIncrement<N>& a) {
  return std::sqrt(inner(a, a));
}

template <std::size_t N>
void add_times(BlockIncrement<N>& to, double factor, const BlockIncrement<N>& what) {
  for (std::size_t v = 0; v < to.q.size(); ++v)
    for (std::size_t k = 0; k < N; ++k) to.q[v][k] += factor * what.q[v][k];
  for (std::size_t z = 0; z < augmented_count; ++z) to.augmented[z] += factor * what.augmented[z];
}

template <std::size_t N>
double BlockAugmentedRows<N>::times(const BlockVector<N>& x) const {
  double sum = 0.0;
  for (const Entry& entry : first)
    for (std::size_t k = 0; k < N; ++k) sum += entry.by[k] * x[entry.vertex][k];
  return sum;
}

template <std::size_t N>
void BlockAugmentedRows<N>::add_transposed(double factor, BlockVector<N>& to) const {
  for (const Entry& entry : first)
    for (std::size_t k = 0; k < N; ++k) to[entry.vertex][k] += entry.by[k] * factor;
}

template <std::size_t N>
BlockIncrement<N> BlockAugmentedMatrix<N>::times(const BlockIncrement<N>& x) const {
  BlockIncrement<N> result = zero_of<N>(x.q.size());
  for (std::size_t r = 0; r < x.q.size(); ++r)
    for (std::size_t z = 0; z < augmented_count; ++z)
      for (std::size_t k = 0; k < N; ++k) result.q[r][k] += columns_[z][r][k] * x.augmented[z];
  add_product(matrix_, 1.0, x.q, result.q);
  result.augmented[0] += rows_.times(x.q);
  for (std::size_t row = 0; row < augmented_count; ++row)
    for (std::size_t z = 0; z < augmented_count; ++z)
      result.augmented[row] += rows_.corner[row][z] * x.augmented[z];
  return result;
}

template <std::size_t N>
BlockIncrement<N> BlockAugmentedMatrix<N>::transposed_times(const BlockIncrement<N>& x) const {
  BlockIncrement<N> result = zero_of<N>(x.q.size());
  add_transposed(matrix_, 1.0, x.q, result.q);
  rows_.add_transposed(x.augmented[0], result.q);
  for (std::size_t z = 0; z < augmented_count; ++z)
    result.augmented[z] =
        inner(columns_[z], x.q) + rows_.corner[0][z] * x.augmented[0] + rows_.corner[1][z] * x.augmented[1];
  return result;
}

template <std::size_t N>
BlockIncrement<N> close_augmented(std::vector<std::array<double, N>> x,
                                  const std::array<std::vector<std::array<double, N>>, augmented_count>& y,
                                  const BlockAugmentedRows<N>& rows, const Augmented& right) {
  // The Schur complement E - D y, where D's second row is empty.
  const double s00 = rows.corner[0][0] - rows.times(y[0]), s01 = rows.corner[0][1] - rows.times(y[1]);
  const double s10 = rows.corner[1][0], s11 = rows.corner[1][1];
  const double r0 = right[0] - rows.times(x), r1 = right[1];
  const double determinant = s00 * s11 - s01 * s10;
  BlockIncrement<N> result;
  result.augmented = {(r0 * s11 - s01 * r1) / determinant, (s00 * r1 - s10 * r0) / determinant};
  for (std::size_t v = 0; v < x.size(); ++v)
    for (std::size_t k = 0; k < N; ++k)
      x[v][k] -= y[0][v][k] * result.augmented[0] + y[1][v][k] * result.augmented[1];
  result.q = std::move(x);
  return result;
}

// For each number of unknowns.
#define REMODEL_AUGMENTED(N)                                                                              \
  template double inner<N>(const std::vector<std::array<double, N>>&,                                     \
                           const std::vector<std::array<double, N>>&);                                    \
  template double inner<N>(const BlockIncrement<N>&, const BlockIncrement<N>&);                           \
  template double norm<N>(const BlockIncrement<N>&);                                                      \
  template void add_times<N>(BlockIncrement<N>&, double, const BlockIncrement<N>&);                       \
  template struct BlockAugmentedRows<N>;                                                                  \
  template class BlockAugmentedMatrix<N>;                                                                 \
  template BlockIncrement<N> close_augmented<N>(std::vector<std::array<double, N>>,                       \
                                                const std::array<std::vector<std::array<double, N>>, 2>&, \
                                                const BlockAugmentedRows<N>&, const Augmented&)
REMODEL_AUGMENTED(4);
REMODEL_AUGMENTED(5);
#undef REMODEL_AUGMENTED

}  // namespace remodel::flow
