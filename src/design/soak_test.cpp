#include "remodel/soak.h"

#include <gtest/gtest.h>

namespace remodel {
namespace {

// Every kind of domain comes up: see soak_cases.h.
TEST(Soak, LeavesNoInvalidMesh) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SoakResult result = soak({.steps = 1000, .seed = seed, .full_check_every = 100});
    EXPECT_EQ(result.steps, 1000U);
    EXPECT_EQ(result.invalid_meshes, 0U) << result.first_failure;
    EXPECT_GT(result.full_adjustments, 0U);
    EXPECT_GT(result.refused, 0U);
  }
}

TEST(Soak, DoesTheSameForTheSameSeed) {
  const SoakResult one = soak({.steps = 300, .seed = 7}), other = soak({.steps = 300, .seed = 7});
  EXPECT_EQ(one.refused, other.refused);
  EXPECT_EQ(one.full_adjustments, other.full_adjustments);
  EXPECT_EQ(one.min_angle_deg, other.min_angle_deg);
}

}  // namespace
}  // namespace remodel
