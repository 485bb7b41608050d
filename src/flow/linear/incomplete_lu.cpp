#include "flow/linear/incomplete_lu.h"

#include <algorithm>
#include <cmath>

#include "geometry/vector_clones.h"

namespace remodel::flow {

namespace {

// All blocks here are by columns, unlike the matrix's, so that four equations are computed side by side.
template <std::size_t N>
SquareBlock<N> by_columns(const SquareBlock<N>& a) {
  SquareBlock<N> result;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) result[N * k + i] = a[N * i + k];
  return result;
}

// a -= b c.
template <std::size_t N>
void subtract_product(SquareBlock<N>& a, const SquareBlock<N>& b, const std::array<float, N * N>& c) {
  for (std::size_t j = 0; j < N; ++j)
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t i = 0; i < N; ++i) a[N * j + i] -= b[N * k + i] * double{c[N * j + k]};
}

// By Gauss and Jordan with pivots from columns; not finite where the block is singular.
template <std::size_t N>
SquareBlock<N> inverse(SquareBlock<N> a) {
  SquareBlock<N> b = {};
  for (std::size_t k = 0; k < N; ++k) b[(N + 1) * k] = 1.0;
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < N; ++i)
      if (std::fabs(a[N * i + k]) > std::fabs(a[N * pivot + k])) pivot = i;
    const double factor = 1.0 / a[N * pivot + k];
    for (std::size_t j = 0; j < N; ++j) {
      std::swap(a[N * k + j], a[N * pivot + j]), std::swap(b[N * k + j], b[N * pivot + j]);
      a[N * k + j] *= factor, b[N * k + j] *= factor;
    }
    for (std::size_t i = 0; i < N; ++i) {
      if (i == k) continue;
      const double times = a[N * i + k];
      for (std::size_t j = 0; j < N; ++j)
        a[N * i + j] -= times * a[N * k + j], b[N * i + j] -= times * b[N * k + j];
    }
  }
  return b;
}

template <std::size_t N>
std::array<float, N * N> rounded(const SquareBlock<N>& a) {
  std::array<float, N * N> result;
  for (std::size_t i = 0; i < N * N; ++i) result[i] = static_cast<float>(a[i]);
  return result;
}

// y -= a x.
template <std::size_t N>
void subtract(std::array<double, N>& y, const std::array<float, N * N>& a, const std::array<double, N>& x) {
  for (std::size_t k = 0; k < N; ++k)
    for (std::size_t i = 0; i < N; ++i) y[i] -= double{a[N * k + i]} * x[k];
}

// y -= the transposed a times x.
template <std::size_t N>
void subtract_transposed(std::array<double, N>& y, const std::array<float, N * N>& a,
                         const std::array<double, N>& x) {
  for (std::size_t k = 0; k < N; ++k)
    for (std::size_t i = 0; i < N; ++i) y[k] -= double{a[N * k + i]} * x[i];
}

// The factors, as they are kept: L, whose own diagonal is 1; inverse diagonal; U.
template <std::size_t N>
struct FactorRows {
  std::span<const std::uint32_t> row_at, start, diagonal, column;
  std::span<const std::array<float, N * N>> block;
};

template <std::size_t N>
[[gnu::always_inline]] inline void solve_rows(const FactorRows<N>& f, std::span<std::array<double, N>> x) {
  const std::size_t size = f.row_at.size();
  std::vector<std::array<double, N>> y(size);
  for (std::size_t i = 0; i < size; ++i) {
    std::array<double, N> sum = x[f.row_at[i]];
    for (std::uint32_t at = f.start[i]; at < f.diagonal[i]; ++at)
      subtract<N>(sum, f.block[at], y[f.column[at]]);
    y[i] = sum;
  }
  for (std::size_t i = size; i-- > 0;) {
    std::array<double, N> sum = y[i], result = {};
    for (std::uint32_t at = f.diagonal[i] + 1; at < f.start[i + 1]; ++at)
      subtract<N>(sum, f.block[at], y[f.column[at]]);
    for (double& value : sum) value = -value;
    subtract<N>(result, f.block[f.diagonal[i]], sum);
    x[f.row_at[i]] = y[i] = result;
  }
}

// No templates: the compiler makes no clones of a template that the same unit has used before. With AVX2 they
// take a third of the time.
REMODEL_VECTOR_CLONES void solve_by(const FactorRows<4>& f, std::span<std::array<double, 4>> x) {
  solve_rows(f, x);
}
REMODEL_VECTOR_CLONES void solve_by(const FactorRows<5>& f, std::span<std::array<double, 5>> x) {
  solve_rows(f, x);
}

}  // namespace

// Reverse Cuthill-McKee: by breadth, neighbours of few neighbours first, from a vertex that is far from
// another.
template <std::size_t N>
void IncompleteLu<N>::order(const BlockMatrix<N>& matrix) {
  const auto size = static_cast<std::uint32_t>(matrix.rows.size());
  const auto degree = [&](std::uint32_t v) { return matrix.start[v + 1] - matrix.start[v]; };
  std::vector<std::uint32_t> seen(size, 0), next;
  std::uint32_t sweep = 0;
  const auto spread = [&](std::uint32_t root, std::vector<std::uint32_t>& row) {
    ++sweep;
    const std::size_t first = row.size();
    row.push_back(root), seen[root] = sweep;
    for (std::size_t i = first; i < row.size(); ++i) {
      next.clear();
      for (std::uint32_t j = matrix.start[row[i]]; j < matrix.start[row[i] + 1]; ++j)
        if (const std::uint32_t v = matrix.column[j]; seen[v] != sweep) seen[v] = sweep, next.push_back(v);
      std::sort(next.begin(), next.end(), [&](std::uint32_t a, std::uint32_t b) {
        return degree(a) != degree(b) ? degree(a) < degree(b) : a < b;
      });
      row.insert(row.end(), next.begin(), next.end());
    }
  };
  row_at_.clear();
  std::vector<bool> placed(size, false);
  for (std::uint32_t v = 0; v < size; ++v) {
    if (placed[v]) continue;
    std::vector<std::uint32_t> trial;
    spread(v, trial);
    const std::size_t from = row_at_.size();
    spread(trial.back(), row_at_);
    for (std::size_t i = from; i < row_at_.size(); ++i) placed[row_at_[i]] = true;
  }
  std::reverse(row_at_.begin(), row_at_.end());
  place_of_.resize(size);
  for (std::uint32_t p = 0; p < size; ++p) place_of_[row_at_[p]] = p;
}

// Row by row: the level of what row k adds at j is that of (i, k) and of (k, j) and 1 more. `next` links the
// columns of the row in order, from `size` and back to it.
template <std::size_t N>
void IncompleteLu<N>::fill_pattern(const BlockMatrix<N>& matrix, int level) {
  const auto size = static_cast<std::uint32_t>(matrix.rows.size());
  std::vector<std::uint32_t> next(size + 1), own;
  std::vector<int> level_of(size, level + 1), levels;
  start_.assign(1, 0), diagonal_.clear(), column_.clear();
  for (std::uint32_t i = 0; i < size; ++i) {
    own.clear();
    const std::uint32_t row = row_at_[i];
    for (std::uint32_t j = matrix.start[row]; j < matrix.start[row + 1]; ++j)
      own.push_back(place_of_[matrix.column[j]]);
    std::sort(own.begin(), own.end());
    std::uint32_t last = size;
    for (const std::uint32_t j : own) next[last] = j, level_of[j] = 0, last = j;
    next[last] = size;
    for (std::uint32_t k = next[size]; k < i; k = next[k]) {
      if (level_of[k] == level) continue;
      std::uint32_t behind = k;
      for (std::uint32_t at = diagonal_[k] + 1; at < start_[k + 1]; ++at) {
        const std::uint32_t j = column_[at];
        const int added = level_of[k] + levels[at] + 1;
        if (added > level) continue;
        while (next[behind] < j) behind = next[behind];
        if (next[behind] != j) next[j] = next[behind], next[behind] = j;
        level_of[j] = std::min(level_of[j], added);
      }
    }
    for (std::uint32_t j = next[size]; j != size; j = next[j]) {
      if (j == i) diagonal_.push_back(static_cast<std::uint32_t>(column_.size()));
      column_.push_back(j), levels.push_back(level_of[j]);
      level_of[j] = level + 1;
    }
    start_.push_back(static_cast<std::uint32_t>(column_.size()));
  }
}

template <std::size_t N>
double IncompleteLu<N>::analysed_mb(const BlockMatrix<N>& matrix, int level) {
  if (level_ != level || !is_of(matrix)) {
    forget();
    order(matrix);
    fill_pattern(matrix, level);
    matrix_start_ = matrix.start, matrix_column_ = matrix.column, level_ = level;
  }
  return memory_mb();
}

template <std::size_t N>
bool IncompleteLu<N>::factor(const BlockMatrix<N>& matrix) {
  ready_ = false;
  block_.resize(column_.size());
  const auto size = static_cast<std::uint32_t>(row_at_.size());
  std::vector<SquareBlock<N>> row(size);  // by place; of the row under way alone
  std::vector<std::uint32_t> holds(size, size);
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t at = start_[i]; at < start_[i + 1]; ++at)
      row[column_[at]] = {}, holds[column_[at]] = i;
    const std::uint32_t r = row_at_[i];
    for (std::uint32_t j = matrix.start[r]; j < matrix.start[r + 1]; ++j)
      row[place_of_[matrix.column[j]]] = by_columns<N>(matrix.block[j]);
    for (std::uint32_t at = start_[i]; at < diagonal_[i]; ++at) {
      const std::uint32_t k = column_[at];
      SquareBlock<N> factor = {};
      subtract_product<N>(factor, row[k], block_[diagonal_[k]]);
      for (double& value : factor) value = -value;
      block_[at] = rounded<N>(factor);
      for (std::uint32_t u = diagonal_[k] + 1; u < start_[k + 1]; ++u)
        if (const std::uint32_t j = column_[u]; holds[j] == i) subtract_product<N>(row[j], factor, block_[u]);
    }
    block_[diagonal_[i]] = rounded<N>(inverse<N>(row[i]));
    for (std::uint32_t at = diagonal_[i] + 1; at < start_[i + 1]; ++at)
      block_[at] = rounded<N>(row[column_[at]]);
    for (const float x : block_[diagonal_[i]])
      if (!std::isfinite(x)) return false;
  }
  return ready_ = true;
}

template <std::size_t N>
void IncompleteLu<N>::solve(std::span<std::array<double, N>> x) const {
  solve_by({row_at_, start_, diagonal_, column_, block_}, x);
}

template <std::size_t N>
void IncompleteLu<N>::solve_transposed(std::span<std::array<double, N>> x) const {
  const std::size_t size = row_at_.size();
  std::vector<std::array<double, N>> y(size);
  for (std::size_t i = 0; i < size; ++i) y[i] = x[row_at_[i]];
  for (std::size_t i = 0; i < size; ++i) {
    std::array<double, N> minus = y[i], result = {};
    for (double& value : minus) value = -value;
    subtract_transposed<N>(result, block_[diagonal_[i]], minus);
    y[i] = result;
    for (std::uint32_t at = diagonal_[i] + 1; at < start_[i + 1]; ++at)
      subtract_transposed<N>(y[column_[at]], block_[at], result);
  }
  for (std::size_t i = size; i-- > 0;) {
    for (std::uint32_t at = start_[i]; at < diagonal_[i]; ++at)
      subtract_transposed<N>(y[column_[at]], block_[at], y[i]);
    x[row_at_[i]] = y[i];
  }
}

template <std::size_t N>
double IncompleteLu<N>::memory_mb() const {
  return 1e-6 * static_cast<double>(column_.size() * (sizeof(SmallBlock) + sizeof(std::uint32_t)));
}

template class IncompleteLu<4>;
template class IncompleteLu<5>;

}  // namespace remodel::flow
