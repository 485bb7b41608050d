// The same solver by Eigen's SparseLU, for machines without Fortran: the page of `remodel live`. Vertices are
// ordered by approximate minimum degree, and pivots are looked for near the diagonal, which is heavy.

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>

#include "flow/linear/direct_solver.h"

namespace remodel::flow {

namespace {

using Rows = Eigen::SparseMatrix<float, Eigen::RowMajor, int>;
using Columns = Eigen::SparseMatrix<float, Eigen::ColMajor, int>;

// The diagonal's entry is the pivot from this part of the column's largest on.
constexpr float pivot_threshold = 0.01F;
constexpr double bytes_of_entry = sizeof(float) + sizeof(int);

}  // namespace

template <std::size_t N>
struct DirectSolver<N>::Impl {
  std::vector<std::uint32_t> start, column;  // of the pattern that was analysed
  std::vector<std::uint32_t> row_at;  // per row of the factors the matrix's row; and the other way round
  std::vector<int> place;
  Rows rows;
  Columns matrix;
  Eigen::SparseLU<Columns, Eigen::NaturalOrdering<int>> lu;
  Eigen::VectorXf right;
  double estimate = 0.0;  // of the factors' entries
  bool factored = false;

  void order(const BlockMatrix<N>& given);
  void fill(const BlockMatrix<N>& given);
  double operations();
  template <class Solve>
  void solve(std::span<std::array<double, N>> right_sides, std::size_t count, const Solve& solve_one);
};

namespace {

// The entries of the lower factor of a symmetric pattern without pivoting, its diagonal among them. Row i has
// one in every column on the way from its own entries up the elimination tree to i. Source: J. W. H. Liu,
// SIAM J. Matrix Anal. Appl. 11 (1990), section 5.
double blocks_of_cholesky(const Columns& graph) {
  std::vector<int> parent(static_cast<std::size_t>(graph.cols()), -1), seen = parent;
  double count = 0.0;
  for (int i = 0; i < graph.cols(); ++i) {
    seen[static_cast<std::size_t>(i)] = i;
    ++count;
    for (Columns::InnerIterator entry(graph, i); entry && entry.row() < i; ++entry)
      for (auto j = static_cast<std::size_t>(entry.row()); seen[j] != i;
           j = static_cast<std::size_t>(parent[j])) {
        if (parent[j] < 0) parent[j] = i;
        seen[j] = i;
        ++count;
      }
  }
  return count;
}

// Per vertex its row, -1 where it has none.
template <std::size_t N>
std::vector<int> positions(const BlockMatrix<N>& matrix) {
  std::uint32_t highest = 0;
  for (const std::uint32_t row : matrix.rows) highest = std::max(highest, row);
  for (const std::uint32_t column : matrix.column) highest = std::max(highest, column);
  std::vector<int> position(highest + 1, -1);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) position[matrix.rows[r]] = static_cast<int>(r);
  return position;
}

}  // namespace

// Orders the graph of vertices, whose unknowns stay together.
template <std::size_t N>
void DirectSolver<N>::Impl::order(const BlockMatrix<N>& given) {
  const std::vector<int> position = positions(given);
  const int size = static_cast<int>(given.rows.size());
  std::vector<Eigen::Triplet<float>> edges;
  edges.reserve(given.column.size());
  for (int r = 0; r < size; ++r)
    for (std::uint32_t i = given.start[r]; i < given.start[r + 1]; ++i)
      if (position[given.column[i]] >= 0) edges.emplace_back(r, position[given.column[i]], 1.0F);
  Columns graph(size, size);  // which is symmetric
  graph.setFromTriplets(edges.begin(), edges.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> found;
  Eigen::AMDOrdering<int>()(graph, found);
  row_at.resize(given.rows.size());
  place.resize(given.rows.size());
  for (int k = 0; k < size; ++k) {
    row_at[k] = static_cast<std::uint32_t>(found.indices()[k]);
    place[row_at[k]] = k;
  }
  Columns ordered(size, size);
  ordered = graph.twistedBy(Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(found.transpose()));
  estimate = double{N * N} * 2.0 * blocks_of_cholesky(ordered);
}

template <std::size_t N>
void DirectSolver<N>::Impl::fill(const BlockMatrix<N>& given) {
  const std::vector<int> position = positions(given);
  const int size = static_cast<int>(given.rows.size());
  constexpr int n = N;
  rows.resize(n * size, n * size);
  rows.reserve(static_cast<Eigen::Index>(N * N * given.column.size()));
  std::vector<std::pair<int, std::uint32_t>> entries;  // column of the factors, block
  for (int k = 0; k < size; ++k) {
    entries.clear();
    const std::uint32_t r = row_at[k];
    for (std::uint32_t i = given.start[r]; i < given.start[r + 1]; ++i)
      if (const int c = position[given.column[i]]; c >= 0) entries.emplace_back(place[c], i);
    std::sort(entries.begin(), entries.end());
    for (int equation = 0; equation < n; ++equation) {
      rows.startVec(n * k + equation);
      for (const auto& [c, block] : entries)
        for (int unknown = 0; unknown < n; ++unknown)
          rows.insertBack(n * k + equation, n * c + unknown) =
              static_cast<float>(given.block[block][n * equation + unknown]);
    }
  }
  rows.finalize();
  matrix = rows;
}

// Two for each pair of an entry of a column of L and one of the row of U, which is as long: of the last
// factors.
template <std::size_t N>
double DirectSolver<N>::Impl::operations() {
  const auto& l = lu.matrixL().m_mapL;
  double sum = 0.0;
  for (Eigen::Index s = 0; s <= l.nsuper(); ++s) {
    const int first = l.supToCol()[s], end = l.supToCol()[s + 1];
    const int longest = l.rowIndexPtr()[first + 1] - l.rowIndexPtr()[first];
    for (int c = first; c < end; ++c) {
      const double length = longest - (c - first);
      sum += 2.0 * length * length;
    }
  }
  return sum;
}

template <std::size_t N>
DirectSolver<N>::DirectSolver() = default;
template <std::size_t N>
DirectSolver<N>::~DirectSolver() = default;
template <std::size_t N>
DirectSolver<N>::DirectSolver(DirectSolver&&) noexcept = default;
template <std::size_t N>
DirectSolver<N>& DirectSolver<N>::operator=(DirectSolver&&) noexcept = default;

template <std::size_t N>
bool DirectSolver<N>::ready() const {
  return impl_ && impl_->factored;
}

template <std::size_t N>
void DirectSolver<N>::forget() {
  impl_.reset();
}

template <std::size_t N>
Factored DirectSolver<N>::factor(const BlockMatrix<N>& matrix, double memory_mb) {
  if (!impl_) impl_ = std::make_unique<Impl>();
  const bool same = impl_->start == matrix.start && impl_->column == matrix.column;
  if (!same && !impl_->start.empty()) impl_ = std::make_unique<Impl>();
  impl_->factored = false;
  if (!same) impl_->order(matrix);
  if (1e-6 * bytes_of_entry * impl_->estimate > memory_mb) {
    impl_.reset();
    return Factored::out_of_memory;
  }
  impl_->fill(matrix);
  if (!same) {
    impl_->lu.isSymmetric(true);
    impl_->lu.setPivotThreshold(pivot_threshold);
    impl_->lu.analyzePattern(impl_->matrix);
    impl_->start = matrix.start, impl_->column = matrix.column;
  }
  impl_->lu.factorize(impl_->matrix);
  // Eigen says in words alone that memory ran out, and info() may still be that of the factors before.
  const bool lacks_memory = impl_->lu.lastErrorMessage().rfind("UNABLE TO", 0) == 0;
  if (lacks_memory || impl_->lu.info() != Eigen::Success) {
    impl_ = std::make_unique<Impl>();
    return lacks_memory ? Factored::out_of_memory : Factored::singular;
  }
  if (this->memory_mb() > memory_mb) return Factored::out_of_memory;
  impl_->factored = true;
  return Factored::done;
}

template <std::size_t N>
template <class Solve>
void DirectSolver<N>::Impl::solve(std::span<std::array<double, N>> right_sides, std::size_t count,
                                  const Solve& solve_one) {
  const std::size_t size = row_at.size();
  right.resize(static_cast<Eigen::Index>(N * size));
  for (std::size_t n = 0; n < count; ++n) {
    const auto one = right_sides.subspan(n * size, size);
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t i = 0; i < N; ++i)
        right[static_cast<Eigen::Index>(N * k + i)] = static_cast<float>(one[row_at[k]][i]);
    const Eigen::VectorXf solution = solve_one(right);
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t i = 0; i < N; ++i)
        one[row_at[k]][i] = double{solution[static_cast<Eigen::Index>(N * k + i)]};
  }
}

template <std::size_t N>
void DirectSolver<N>::solve(std::span<std::array<double, N>> right, std::size_t count) {
  impl_->solve(right, count, [this](const auto& b) -> Eigen::VectorXf { return impl_->lu.solve(b); });
}

template <std::size_t N>
void DirectSolver<N>::solve_transposed(std::span<std::array<double, N>> right, std::size_t count) {
  impl_->solve(right, count,
               [this](const auto& b) -> Eigen::VectorXf { return impl_->lu.transpose().solve(b); });
}

template <std::size_t N>
double DirectSolver<N>::memory_mb() const {
  return impl_ ? bytes_of_entry * 1e-6 * static_cast<double>(impl_->lu.nnzL() + impl_->lu.nnzU()) : 0.0;
}

template <std::size_t N>
double DirectSolver<N>::solve_work() const {
  return impl_ ? static_cast<double>(impl_->lu.nnzL() + impl_->lu.nnzU()) : 0.0;
}

// As MUMPS's: six dense operations take as long as one that waits for memory; assembly and Jacobian come on
// top.
template <std::size_t N>
double DirectSolver<N>::factor_work() const {
  return impl_ ? impl_->operations() / 6.0 + 12.0 * static_cast<double>(impl_->rows.nonZeros()) : 0.0;
}

template class DirectSolver<4>;
template class DirectSolver<5>;

}  // namespace remodel::flow
