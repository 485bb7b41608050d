#include "flow/linear/augmented.h"

#include <cmath>

namespace remodel::flow {

Increment zero(std::size_t vertices) {
  return {.q = Vector(vertices), .augmented = {}};
}

// It keeps as many sums side by side as a vertex has unknowns.
double inner(const Vector& a, const Vector& b) {
  Unknowns<double> sum = {};
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < unknown_count; ++k) sum[k] += a[v][k] * b[v][k];
  double total = 0.0;
  for (std::size_t k = 0; k + 1 < unknown_count; k += 2) total += sum[k] + sum[k + 1];
  return unknown_count % 2 == 0 ? total : total + sum[unknown_count - 1];
}

double inner(const Increment& a, const Increment& b) {
  return inner(a.q, b.q) + (a.augmented[0] * b.augmented[0] + a.augmented[1] * b.augmented[1]);
}

double norm(const Increment& a) {
  return std::sqrt(inner(a, a));
}

void add_times(Increment& to, double factor, const Increment& what) {
  for (std::size_t v = 0; v < to.q.size(); ++v)
    for (std::size_t k = 0; k < unknown_count; ++k) to.q[v][k] += factor * what.q[v][k];
  for (std::size_t z = 0; z < augmented_count; ++z) to.augmented[z] += factor * what.augmented[z];
}

double AugmentedRows::times(const Vector& x) const {
  double sum = 0.0;
  for (const Entry& entry : first)
    for (std::size_t k = 0; k < unknown_count; ++k) sum += entry.by[k] * x[entry.vertex][k];
  return sum;
}

void AugmentedRows::add_transposed(double factor, Vector& to) const {
  for (const Entry& entry : first)
    for (std::size_t k = 0; k < unknown_count; ++k) to[entry.vertex][k] += entry.by[k] * factor;
}

Increment AugmentedMatrix::times(const Increment& x) const {
  Increment result = zero(x.q.size());
  for (std::size_t r = 0; r < x.q.size(); ++r)
    for (std::size_t z = 0; z < augmented_count; ++z)
      for (std::size_t k = 0; k < unknown_count; ++k) result.q[r][k] += columns_[z][r][k] * x.augmented[z];
  add_product(matrix_, 1.0, x.q, result.q);
  result.augmented[0] += rows_.times(x.q);
  for (std::size_t row = 0; row < augmented_count; ++row)
    for (std::size_t z = 0; z < augmented_count; ++z)
      result.augmented[row] += rows_.corner[row][z] * x.augmented[z];
  return result;
}

Increment AugmentedMatrix::transposed_times(const Increment& x) const {
  Increment result = zero(x.q.size());
  add_transposed(matrix_, 1.0, x.q, result.q);
  rows_.add_transposed(x.augmented[0], result.q);
  for (std::size_t z = 0; z < augmented_count; ++z)
    result.augmented[z] =
        inner(columns_[z], x.q) + rows_.corner[0][z] * x.augmented[0] + rows_.corner[1][z] * x.augmented[1];
  return result;
}

Increment close_augmented(Vector x, const std::array<Vector, augmented_count>& y, const AugmentedRows& rows,
                          const Augmented& right) {
  // The Schur complement E - D y, where D's second row is empty.
  const double s00 = rows.corner[0][0] - rows.times(y[0]), s01 = rows.corner[0][1] - rows.times(y[1]);
  const double s10 = rows.corner[1][0], s11 = rows.corner[1][1];
  const double r0 = right[0] - rows.times(x), r1 = right[1];
  const double determinant = s00 * s11 - s01 * s10;
  Increment result;
  result.augmented = {(r0 * s11 - s01 * r1) / determinant, (s00 * r1 - s10 * r0) / determinant};
  for (std::size_t v = 0; v < x.size(); ++v)
    for (std::size_t k = 0; k < unknown_count; ++k)
      x[v][k] -= y[0][v][k] * result.augmented[0] + y[1][v][k] * result.augmented[1];
  result.q = std::move(x);
  return result;
}

}  // namespace remodel::flow
