#include "layer/heights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "remodel/error.h"
#include "remodel/layers.h"

namespace remodel {
namespace {

TEST(Heights, TheFirstHeightIsThatOfAFlatPlate) {
  for (const double reynolds : {1e4, 6e6, 1e8}) {
    const double friction = 0.026 * std::pow(reynolds, -1.0 / 7.0);
    EXPECT_NEAR(first_height(1.0, reynolds) * reynolds * std::sqrt(friction / 2.0), 1.0, 1e-13);
    EXPECT_NEAR(boundary_layer_thickness(reynolds), 0.37 * std::pow(reynolds, -0.2), 1e-15);
  }
  EXPECT_NEAR(first_height(1.0, 6e6), 4.5e-6, 0.05e-6);
  EXPECT_DOUBLE_EQ(first_height(30.0, 6e6), 30.0 * first_height(1.0, 6e6));
  EXPECT_THROW(first_height(0.0, 6e6), Error);
  EXPECT_THROW(first_height(1.0, 0.0), Error);
  EXPECT_THROW(first_height(1.0, std::nan("")), Error);
}

TEST(Heights, LevelsFillTheThicknessWithTheFirstHeightAndNoMoreGrowthThanAsked) {
  for (const double first : {3e-7, 4.5e-6, 1.3e-4, 1e-3})
    for (const double growth : {1.02, 1.1, 1.2, 1.5}) {
      const double thickness = 0.02;
      const std::uint32_t count = level_count(first, growth, thickness);
      const double ratio = growth_of(first, growth, thickness, count);
      EXPECT_LE(ratio, growth);
      std::vector<double> heights(count);
      level_heights(first, ratio, thickness, heights);
      EXPECT_EQ(heights.front(), first);
      EXPECT_EQ(heights.back(), thickness);
      EXPECT_NEAR(first * geometric_sum(ratio, count), thickness, 1e-13);
      EXPECT_LT(first * geometric_sum(growth, count - 1), thickness) << "one cell less would do";
    }
}

TEST(Heights, ThinColumnsAreUniform) {
  std::vector<double> heights(10);
  EXPECT_EQ(growth_of(1e-3, 1.2, 5e-3, 10), 1.0);
  level_heights(1e-3, 1.0, 5e-3, heights);
  for (std::size_t j = 0; j < 10; ++j) EXPECT_NEAR(heights[j], 5e-4 * static_cast<double>(j + 1), 1e-17);
}

TEST(Heights, ANumberOfCellsGivesAThicknessThatTakesThisNumber) {
  for (int count = 1; count < 60; ++count)
    EXPECT_EQ(level_count(4.5e-6, 1.2, thickness_of(4.5e-6, 1.2, count)), static_cast<std::uint32_t>(count));
}

}  // namespace
}  // namespace remodel
