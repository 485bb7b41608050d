#include "remodel/snapshots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "transfer/test_transfers.h"

namespace remodel {
namespace {

// Designs move a hole by a little: its vertices move in place, or, far enough, are replaced.
Domain hole_at(double x, double y) {
  return test::with_holes({test::circle_hole(0.5 + x, 0.5 + y, 0.2)});
}

// A state of the design: affine, and with a part of second order.
std::vector<double> state_of_design(const std::vector<double>& d, double bend) {
  std::vector<double> values;
  for (int i = 0; i < 5; ++i)
    values.push_back(i + (1.0 + i) * d[0] - 2.0 * i * d[1] + bend * (d[0] * d[0] + i * d[0] * d[1]));
  return values;
}

class OfAHole : public testing::Test {
 protected:
  void go(const std::vector<double>& d) {
    const Mark mark = mesh.mark();
    remodel(mesh, hole_at(d[0], d[1]), {.strategy = Strategy::chain});
    ASSERT_TRUE(mesh.changes_since(mark).same_connectivity());
  }
  Mesh mesh = generate(hole_at(0, 0)).mesh;
};

double largest_error(const std::vector<double>& a, const std::vector<double>& b) {
  double error = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) error = std::max(error, std::abs(a[i] - b[i]));
  return error;
}

TEST_F(OfAHole, AffineStatesAreReproduced) {
  Snapshots snapshots({.regularisation = 0.0});
  EXPECT_FALSE(snapshots.start(mesh, std::vector{0.0, 0.0}));
  for (const std::vector<double>& d :
       {std::vector{0.0, 0.0}, std::vector{1e-3, 0.0}, std::vector{0.0, 1e-3}}) {
    go(d);
    snapshots.add(mesh, d, state_of_design(d, 0.0));
  }
  const std::vector<double> d{-7e-4, 1.5e-3};
  go(d);
  const auto start = snapshots.start(mesh, d);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->snapshots, 3U);
  EXPECT_LT(start->misfit, 1e-10);
  EXPECT_LT(largest_error(start->values, state_of_design(d, 0.0)), 1e-12);
}

TEST_F(OfAHole, WhatIsSmoothIsRightToSecondOrder) {
  std::vector<double> combined, nearest;
  for (const double size : {1e-3, 5e-4}) {
    Snapshots snapshots;
    for (const std::vector<double>& d :
         {std::vector{0.0, 0.0}, std::vector{size, 0.0}, std::vector{0.0, size}}) {
      go(d);
      snapshots.add(mesh, d, state_of_design(d, 3.0));
    }
    const std::vector<double> d{0.6 * size, 0.9 * size};
    go(d);
    combined.push_back(largest_error(snapshots.start(mesh, d)->values, state_of_design(d, 3.0)));
    nearest.push_back(largest_error(state_of_design({0.0, size}, 3.0), state_of_design(d, 3.0)));
  }
  EXPECT_NEAR(std::log2(combined[0] / combined[1]), 2.0, 0.1);
  EXPECT_NEAR(std::log2(nearest[0] / nearest[1]), 1.0, 0.1);
  EXPECT_LT(combined[0], 0.01 * nearest[0]);
}

TEST_F(OfAHole, MemoryIsBounded) {
  Snapshots snapshots({.limit = 4});
  for (int i = 0; i < 10; ++i) {
    const std::vector<double> d{1e-4 * i, 0.0};
    go(d);
    snapshots.add(mesh, d, state_of_design(d, 0.0));
    EXPECT_EQ(snapshots.size(), static_cast<std::size_t>(std::min(i + 1, 4)));
  }
  EXPECT_THROW(snapshots.add(mesh, std::vector{0.0}, state_of_design({0.0, 0.0}, 0.0)), Error);
  EXPECT_THROW(snapshots.add(mesh, std::vector{0.0, 0.0}, {1.0}), Error);
  EXPECT_THROW(snapshots.add(mesh, std::vector{NAN, 0.0}, state_of_design({0.0, 0.0}, 0.0)), Error);
  EXPECT_THROW(snapshots.start(mesh, std::vector{0.0}), Error);
}

TEST_F(OfAHole, AReplacementEndsThem) {
  Snapshots snapshots;
  snapshots.add(mesh, std::vector{0.0, 0.0}, {1.0, 2.0});
  const Mark mark = mesh.mark();
  remodel(mesh, hole_at(0.1, 0.05), {.strategy = Strategy::chain});
  ASSERT_FALSE(mesh.changes_since(mark).same_connectivity());
  EXPECT_FALSE(snapshots.start(mesh, std::vector{0.1, 0.05}));
  EXPECT_EQ(snapshots.size(), 0U);
  snapshots.add(mesh, std::vector{0.1, 0.05}, {1.0, 2.0, 3.0});
  EXPECT_EQ(snapshots.start(mesh, std::vector{0.1, 0.05})->values, (std::vector{1.0, 2.0, 3.0}));
}

TEST(Snapshots, WithoutAMeshTheCallerSaysWhereTheyEnd) {
  Snapshots snapshots({.limit = 2, .regularisation = 0.0});
  EXPECT_FALSE(snapshots.start(std::vector{0.0}));
  for (const double d : {0.0, 1.0, 2.0}) snapshots.add(std::vector{d}, {3.0 * d, 1.0 - d});
  ASSERT_EQ(snapshots.kept().size(), 2U);
  EXPECT_EQ(snapshots.kept().front().design, std::vector{1.0});  // the oldest has gone
  const auto start = snapshots.start(std::vector{4.0});
  ASSERT_TRUE(start);
  EXPECT_EQ(start->base, 1U);
  EXPECT_NEAR(start->values[0], 12.0, 1e-12);
  EXPECT_NEAR(start->values[1], -3.0, 1e-12);
  snapshots.clear();
  EXPECT_FALSE(snapshots.start(std::vector{4.0}));
  snapshots.add(std::vector{1.0, 2.0}, {5.0});  // of another connectivity: other sizes
  EXPECT_EQ(snapshots.start(std::vector{1.0, 2.0})->values, std::vector{5.0});
}

}  // namespace
}  // namespace remodel
