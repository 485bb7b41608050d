#include "flow/linear/incomplete_lu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "flow/linear/augmented.h"
#include "flow/linear/gmres.h"
#include "flow/linear/test_vectors.h"

namespace remodel::flow {
namespace {

// Of a strip of vertices, each joined with those at most two places on: its elimination fills nothing in, so
// that incomplete factors are whole ones. `bridge`: the first and the last are joined too.
template <std::size_t N>
BlockMatrix<N> strip_matrix(std::uint32_t size, bool bridge, std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  BlockMatrix<N> matrix{.rows = {}, .start = {0}, .column = {}, .block = {}};
  for (std::uint32_t row = 0; row < size; ++row) {
    matrix.rows.push_back(row);
    for (std::uint32_t other = 0; other < size; ++other) {
      const std::uint32_t distance = row > other ? row - other : other - row;
      if (distance > 2 && !(bridge && distance == size - 1)) continue;
      SquareBlock<N> block;
      for (double& value : block) value = entry(random);
      if (distance == 0)
        for (std::size_t k = 0; k < N; ++k) block[(N + 1) * k] += 2.25 * N;
      matrix.column.push_back(other);
      matrix.block.push_back(block);
    }
    matrix.start.push_back(static_cast<std::uint32_t>(matrix.column.size()));
  }
  return matrix;
}

// The larger error of a solution by these factors alone, transposed or not.
template <std::size_t N>
double error_of(const BlockMatrix<N>& matrix, int level, std::mt19937& random) {
  IncompleteLu<N> factors;
  const double expected_mb = factors.analysed_mb(matrix, level);
  EXPECT_FALSE(factors.ready());
  EXPECT_TRUE(factors.factor(matrix));
  EXPECT_TRUE(factors.ready() && factors.is_of(matrix));
  EXPECT_EQ(factors.memory_mb(), expected_mb);
  const BlockVector<N> x = random_vector<N>(matrix.rows.size(), random);
  BlockVector<N> plain = product(matrix, x, false), transposed = product(matrix, x, true);
  factors.solve(plain), factors.solve_transposed(transposed);
  return std::max(distance(plain, x), distance(transposed, x));
}

// Blocks of four and of five.
template <class Size>
class IncompleteLus : public ::testing::Test {};
using Sizes =
    ::testing::Types<std::integral_constant<std::size_t, 4>, std::integral_constant<std::size_t, 5>>;
TYPED_TEST_SUITE(IncompleteLus, Sizes);

TYPED_TEST(IncompleteLus, IsTheWholeLuWhereNothingIsFilledIn) {
  constexpr std::size_t N = TypeParam::value;
  std::mt19937 random(1);
  EXPECT_LT(error_of(strip_matrix<N>(50, false, random), 0, random), 1e-5);  // single precision
}

TYPED_TEST(IncompleteLus, ComesCloserByLevels) {
  constexpr std::size_t N = TypeParam::value;
  std::mt19937 random(2);
  const BlockMatrix<N> matrix = strip_matrix<N>(50, true, random);
  const double rough = error_of(matrix, 0, random), whole = error_of(matrix, 50, random);
  EXPECT_GT(rough, 1e-3);
  EXPECT_LT(rough, 1.0);
  EXPECT_LT(whole, 1e-5);
}

TYPED_TEST(IncompleteLus, SaysThatAMatrixIsSingular) {
  constexpr std::size_t N = TypeParam::value;
  std::mt19937 random(3);
  BlockMatrix<N> matrix = strip_matrix<N>(20, false, random);
  for (std::uint32_t i = matrix.start[5]; i < matrix.start[6]; ++i) matrix.block[i] = {};
  IncompleteLu<N> factors;
  factors.analysed_mb(matrix, 1);
  EXPECT_FALSE(factors.factor(matrix));
  EXPECT_FALSE(factors.ready());
}

TEST(Gmres, SolvesWithIncompleteFactorsAndEndsInTime) {
  std::mt19937 random(4);
  const BlockRows matrix = strip_matrix<unknown_count>(60, true, random);
  IncompleteLu<unknown_count> factors;
  factors.analysed_mb(matrix, 0);
  ASSERT_TRUE(factors.factor(matrix));
  const auto times = [&](const Increment& x) { return Increment{product(matrix, x.q, false), x.augmented}; };
  const auto precondition = [&](Increment& x) { factors.solve(x.q); };
  const Vector exact = random_vector<unknown_count>(60, random);
  const Increment right{product(matrix, exact, false), {1.0, 2.0}};
  Increment x;
  const GmresEnd end = gmres(times, precondition, right, {.wanted = 1e-12, .restart = 8, .rounds = 20}, x);
  EXPECT_LE(end.residual, 1e-12);
  EXPECT_GT(end.iterations, 3);
  EXPECT_LT(distance(x.q, exact), 1e-11);
  EXPECT_NEAR(x.augmented[1], 2.0, 1e-11);
  // From the solution there is nothing to do; with too little time the guess stays.
  EXPECT_EQ(gmres(times, precondition, right, {.wanted = 1e-11, .restart = 8, .rounds = 20}, x).iterations,
            0);
  Increment none;
  const GmresEnd early = gmres(times, precondition, right,
                               {.wanted = 1e-12, .restart = 8, .rounds = 20, .most_iterations = 2}, none);
  EXPECT_FALSE(early.in_time);
  EXPECT_EQ(early.iterations, 2);
  EXPECT_GT(early.residual, 1e-3);
}

}  // namespace
}  // namespace remodel::flow
