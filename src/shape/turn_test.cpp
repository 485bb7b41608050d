#include "turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support.h"

namespace remodel {
namespace {

TEST(Turn, FoldIsTheSameFromBothEndsToTheLastBit) {
  const auto seed = test::seed(1);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 100000; ++i) {
    const double t = i % 2 == 0 ? uniform(random) : std::exp2(-60.0 * uniform(random));
    ASSERT_EQ(fold(t), fold(1.0 - t)) << "t " << t << " seed " << seed;
    ASSERT_NEAR(fold(t), std::min(t, 1.0 - t), 1.2e-16);
  }
  EXPECT_EQ(fold(0.0), 0.0);
  EXPECT_EQ(fold(1.0), 0.0);
  EXPECT_EQ(fold(0.5), 0.5);
}

TEST(Turn, SineAgreesWithTheLongDoubleSine) {
  for (int i = 0; i <= 100000; ++i) {
    const double u = 0.25 * i / 100000;
    const long double expected = std::sin(std::numbers::pi_v<long double> * static_cast<long double>(u));
    ASSERT_NEAR(sin_half_turns(u), static_cast<double>(expected), 4e-16 * static_cast<double>(expected)) << u;
  }
}

TEST(Turn, DirectionsAreExactAtQuartersAndOnTheUnitCircle) {
  EXPECT_EQ(direction(0.0), (Point{1.0, 0.0}));
  EXPECT_EQ(direction(0.25), (Point{0.0, 1.0}));
  EXPECT_EQ(direction(0.5), (Point{-1.0, 0.0}));
  EXPECT_EQ(direction(0.75), (Point{0.0, -1.0}));
  EXPECT_EQ(direction(3.0), (Point{1.0, 0.0}));
  for (int i = -2000; i <= 2000; ++i) {
    const double turns = i / 777.0;
    const Point d = direction(turns);
    ASSERT_NEAR(d.x, std::cos(2.0 * std::numbers::pi * turns), 5e-15) << turns;
    ASSERT_NEAR(d.y, std::sin(2.0 * std::numbers::pi * turns), 5e-15) << turns;
    ASSERT_NEAR(dot(d, d), 1.0, 1e-15) << turns;
  }
}

TEST(Turn, DirectionsAreMirroredToTheLastBit) {
  for (int i = 0; i <= 5000; ++i) {
    const double f = i / 5000.0;
    const Point d = direction(f);
    const Point e = direction(1.0 - f);
    ASSERT_EQ(d.x, e.x) << f;
    ASSERT_EQ(d.y, -e.y) << f;
  }
}

}  // namespace
}  // namespace remodel
