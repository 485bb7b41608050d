// Solutions of systems whose right-hand sides are made of them. Compiled once for each solver.

#include "flow/linear/direct_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "flow/linear/test_vectors.h"

namespace remodel::flow {
namespace {

// Of a grid, each of whose vertices is joined with those at most two steps away, like the rings of a mesh.
// The diagonal is heavy; `rows` of the grid's vertices, ascending.
template <std::size_t N>
BlockMatrix<N> grid_matrix(int width, const std::vector<std::uint32_t>& rows, std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  BlockMatrix<N> matrix{.rows = rows, .start = {0}, .column = {}, .block = {}};
  for (const std::uint32_t row : rows) {
    const int x = static_cast<int>(row) % width, y = static_cast<int>(row) / width;
    for (int other = 0; other < width * width; ++other) {
      const int distance = std::abs(other % width - x) + std::abs(other / width - y);
      if (distance > 2) continue;
      SquareBlock<N> block;
      for (double& value : block) value = entry(random);
      if (distance == 0)
        for (std::size_t k = 0; k < N; ++k) block[(N + 1) * k] += 3.0 * N;
      matrix.column.push_back(static_cast<std::uint32_t>(other));
      matrix.block.push_back(block);
    }
    matrix.start.push_back(static_cast<std::uint32_t>(matrix.column.size()));
  }
  return matrix;
}

std::vector<std::uint32_t> all_rows(int width) {
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(width) * static_cast<std::size_t>(width));
  for (std::uint32_t i = 0; i < rows.size(); ++i) rows[i] = i;
  return rows;
}

template <std::size_t N>
void add(BlockVector<N>& to, double factor, const BlockVector<N>& what) {
  for (std::size_t i = 0; i < to.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) to[i][k] += factor * what[i][k];
}

// A solve is right to single precision, and corrected by residuals in double precision to that.
template <std::size_t N>
void expect_solved(DirectSolver<N>& solver, const BlockMatrix<N>& matrix, bool transposed,
                   std::mt19937& random) {
  constexpr double single = 1e-4, twice = 1e-11;
  constexpr int corrections = 3;
  const std::size_t size = matrix.rows.size();
  const BlockVector<N> wanted = random_vector<N>(size, random), right = product(matrix, wanted, transposed);
  BlockVector<N> x(size), rest = right;
  for (int i = 0; i <= corrections; ++i) {
    if (transposed)
      solver.solve_transposed(rest, 1);
    else
      solver.solve(rest, 1);
    add(x, 1.0, rest);
    if (i == 0) {
      EXPECT_LT(distance(x, wanted), single);
    }
    rest = right;
    add(rest, -1.0, product(matrix, x, transposed));
  }
  EXPECT_LT(distance(x, wanted), twice);
}

template <std::size_t N>
void expect_solved(DirectSolver<N>& solver, const BlockMatrix<N>& matrix, std::mt19937& random) {
  expect_solved(solver, matrix, false, random);
  expect_solved(solver, matrix, true, random);
  const std::size_t size = matrix.rows.size();
  BlockVector<N> first = random_vector<N>(size, random), second = random_vector<N>(size, random),
                 both = first;
  both.insert(both.end(), second.begin(), second.end());
  solver.solve(both, 2);
  solver.solve(first, 1);
  solver.solve(second, 1);
  first.insert(first.end(), second.begin(), second.end());
  EXPECT_LT(distance(both, first), 1e-5);
}

// Blocks of four and of five.
template <class Size>
class DirectSolvers : public ::testing::Test {};
using Sizes =
    ::testing::Types<std::integral_constant<std::size_t, 4>, std::integral_constant<std::size_t, 5>>;
TYPED_TEST_SUITE(DirectSolvers, Sizes);

TYPED_TEST(DirectSolvers, SolvesWithTheMatrixAndItsTranspose) {
  constexpr std::size_t N = TypeParam::value;
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  DirectSolver<N> solver;
  EXPECT_FALSE(solver.ready());
  for (const int width : {12, 12, 7}) {  // the same pattern again, and another
    const BlockMatrix<N> matrix = grid_matrix<N>(width, all_rows(width), random);
    ASSERT_EQ(solver.factor(matrix, 1000.0), Factored::done);
    EXPECT_TRUE(solver.ready());
    EXPECT_GT(solver.factor_work(), solver.solve_work());
    EXPECT_GT(solver.solve_work(), double{N * N} * static_cast<double>(matrix.rows.size()));
    expect_solved(solver, matrix, random);
  }
  solver.forget();
  EXPECT_FALSE(solver.ready());
}

TYPED_TEST(DirectSolvers, LeavesOutColumnsOutsideItsRows) {
  constexpr std::size_t N = TypeParam::value;
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 3; i < 90; i += 1 + i % 3) some.push_back(i);
  const BlockMatrix<N> matrix = grid_matrix<N>(10, some, random);
  DirectSolver<N> solver;
  ASSERT_EQ(solver.factor(matrix, 1000.0), Factored::done);
  expect_solved(solver, matrix, random);
}

TYPED_TEST(DirectSolvers, MakesNoFactorsThatTakeTooMuch) {
  constexpr std::size_t N = TypeParam::value;
  std::mt19937 random(2);
  const BlockMatrix<N> matrix = grid_matrix<N>(40, all_rows(40), random);
  DirectSolver<N> solver;
  ASSERT_EQ(solver.factor(matrix, 1000.0), Factored::done);
  const double needed = solver.memory_mb();
  for (const double memory_mb : {0.01 * needed, 0.5 * needed}) {
    EXPECT_EQ(solver.factor(matrix, memory_mb), Factored::out_of_memory);
    EXPECT_FALSE(solver.ready());
  }
  for (const double memory_mb : {2.0 * needed, 1e7})  // more than there is: it is a limit, no request
    EXPECT_EQ(solver.factor(matrix, memory_mb), Factored::done);
}

TYPED_TEST(DirectSolvers, SaysThatAMatrixIsSingular) {
  constexpr std::size_t N = TypeParam::value;
  std::mt19937 random(1);
  BlockMatrix<N> matrix = grid_matrix<N>(8, all_rows(8), random);
  for (std::uint32_t i = matrix.start[5]; i < matrix.start[6]; ++i) matrix.block[i] = {};
  DirectSolver<N> solver;
  EXPECT_EQ(solver.factor(matrix, 1000.0), Factored::singular);
  EXPECT_FALSE(solver.ready());
  ASSERT_EQ(solver.factor(grid_matrix<N>(8, all_rows(8), random), 1000.0), Factored::done);
  EXPECT_TRUE(solver.ready());
}

}  // namespace
}  // namespace remodel::flow
