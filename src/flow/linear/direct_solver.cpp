// By MUMPS, sequential. Source: P. R. Amestoy, I. S. Duff, J.-Y. L'Excellent and J. Koster, "A fully
// asynchronous multifrontal solver using distributed dynamic scheduling", SIAM J. Matrix Anal. Appl. 23
// (2001).

#include "flow/linear/direct_solver.h"

#include <smumps_c.h>

#include <algorithm>
#include <mutex>

// OpenBLAS's threads spin on small fronts, which costs more than they bring. Absent where BLAS is another
// one.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace remodel::flow {

namespace {

std::mutex& turn() {
  static std::mutex mutex;
  return mutex;
}

// MUMPS counts from 1, as its manual does.
int& control(SMUMPS_STRUC_C& id, int number) {
  return id.icntl[number - 1];
}

constexpr int initialise = -1, finish = -2, analyse = 1, factorise = 2, solve_factored = 3;
constexpr int use_comm_world = -987654;

bool is_singular(int outcome) {
  return outcome == -10 || outcome == -6;
}

constexpr double bytes_of_entry = sizeof(float);

}  // namespace

template <std::size_t N>
struct DirectSolver<N>::Impl {
  SMUMPS_STRUC_C id = {};
  std::vector<std::uint32_t> start, column;  // of the pattern that was analysed
  std::vector<int> row_number, column_number;
  std::vector<float> values, right;
  bool factored = false;

  Impl() {
    const std::scoped_lock lock(turn());
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
    id.par = 1;
    id.sym = 0;
    id.comm_fortran = use_comm_world;
    id.job = initialise;
    smumps_c(&id);
    for (int stream = 1; stream <= 4; ++stream) control(id, stream) = stream == 4 ? 0 : -1;  // prints nothing
    control(id, 6) = 0;  // no permutation to a heavy diagonal: it is heavy
    // Ordering by PORD. MUMPS's own choice for large matrices is METIS, whose orderings, and with them the
    // last digits of a flow, differ from one process to the next.
    control(id, 7) = 4;
    control(id, 10) = 0;                     // no iterative refinement
    control(id, 14) = 30;                    // percent of memory above the estimate
    control(id, 15) = -static_cast<int>(N);  // the graph is of blocks
    control(id, 16) = 1;                     // threads
  }
  ~Impl() {
    const std::scoped_lock lock(turn());
    id.job = finish;
    smumps_c(&id);
  }
  int run(int job) {
    id.job = job;
    smumps_c(&id);
    return id.infog[0];
  }
  void fill(const BlockMatrix<N>& matrix, bool pattern);
};

template <std::size_t N>
void DirectSolver<N>::Impl::fill(const BlockMatrix<N>& matrix, bool pattern) {
  std::uint32_t highest = 0;
  for (const std::uint32_t row : matrix.rows) highest = std::max(highest, row);
  std::vector<int> position(highest + 1, -1);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) position[matrix.rows[r]] = static_cast<int>(r);
  values.clear();
  if (pattern) row_number.clear(), column_number.clear();
  for (std::size_t r = 0; r < matrix.rows.size(); ++r)
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) {
      const std::uint32_t c = matrix.column[i];
      if (c > highest || position[c] < 0) continue;
      for (const double x : matrix.block[i]) values.push_back(static_cast<float>(x));
      if (!pattern) continue;
      constexpr int n = N;
      for (int j = 0; j < n * n; ++j) {
        row_number.push_back(n * static_cast<int>(r) + j / n + 1);
        column_number.push_back(n * position[c] + j % n + 1);
      }
    }
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
  // The factors hold the matrix at least: often there is no need to ask.
  if (1e-6 * bytes_of_entry * double{N * N} * static_cast<double>(matrix.column.size()) > memory_mb) {
    impl_.reset();
    return Factored::out_of_memory;
  }
  if (!impl_) impl_ = std::make_unique<Impl>();
  const bool same = impl_->start == matrix.start && impl_->column == matrix.column;
  if (!same && !impl_->start.empty()) impl_ = std::make_unique<Impl>();
  impl_->factored = false;
  impl_->fill(matrix, !same);
  const std::scoped_lock lock(turn());
  SMUMPS_STRUC_C& id = impl_->id;
  id.n = static_cast<int>(N * matrix.rows.size());
  id.nnz = static_cast<MUMPS_INT8>(impl_->values.size());
  id.irn = impl_->row_number.data();
  id.jcn = impl_->column_number.data();
  id.a = impl_->values.data();
  if (!same) {
    impl_->start.clear();
    const int outcome = impl_->run(analyse);
    if (outcome < 0) return is_singular(outcome) ? Factored::singular : Factored::out_of_memory;
    impl_->start = matrix.start, impl_->column = matrix.column;
  }
  const double estimate_mb = id.infog[15];  // INFOG(16)
  if (estimate_mb > memory_mb) return Factored::out_of_memory;
  // What MUMPS may take it asks the system for at once.
  constexpr double most = 16.0, least_mb = 64.0;
  control(id, 23) = static_cast<int>(std::min(memory_mb, most * estimate_mb + least_mb));
  // Pivots that were put off take more memory than was estimated.
  constexpr int attempts = 4;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const int outcome = impl_->run(factorise);
    if (outcome >= 0) {
      impl_->factored = true;
      return Factored::done;
    }
    const bool more = outcome == -8 || outcome == -9 || outcome == -11 || outcome == -12;
    if (is_singular(outcome)) return Factored::singular;
    if (!more) return Factored::out_of_memory;
    control(id, 14) *= 2;
  }
  return Factored::out_of_memory;
}

template <std::size_t N>
void DirectSolver<N>::solve(std::span<std::array<double, N>> right, std::size_t count) {
  std::vector<float>& rounded = impl_->right;
  rounded.clear();
  for (const auto& block : right)
    for (const double x : block) rounded.push_back(static_cast<float>(x));
  const std::scoped_lock lock(turn());
  SMUMPS_STRUC_C& id = impl_->id;
  id.nrhs = static_cast<int>(count);
  id.lrhs = id.n;
  id.rhs = rounded.data();
  impl_->run(solve_factored);
  for (std::size_t v = 0; v < right.size(); ++v)
    for (std::size_t k = 0; k < N; ++k) right[v][k] = double{rounded[N * v + k]};
}

template <std::size_t N>
void DirectSolver<N>::solve_transposed(std::span<std::array<double, N>> right, std::size_t count) {
  control(impl_->id, 9) = 0;
  solve(right, count);
  control(impl_->id, 9) = 1;
}

template <std::size_t N>
double DirectSolver<N>::memory_mb() const {
  return impl_ ? impl_->id.infog[21] : 0.0;  // INFOG(22): megabytes used
}

template <std::size_t N>
double DirectSolver<N>::solve_work() const {
  if (!impl_) return 0.0;
  const int entries = impl_->id.infog[28];  // INFOG(29): entries in the factors, negative: millions
  return entries >= 0 ? entries : -1e6 * entries;
}

// A dense operation takes about a sixth of one that waits for memory; assembly and Jacobian come on top.
template <std::size_t N>
double DirectSolver<N>::factor_work() const {
  return impl_ ? impl_->id.rinfog[2] / 6.0 + 12.0 * static_cast<double>(impl_->values.size()) : 0.0;
}

template class DirectSolver<4>;
template class DirectSolver<5>;

}  // namespace remodel::flow
