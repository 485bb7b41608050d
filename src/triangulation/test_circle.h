#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "triangulation/circle.h"

namespace remodel::test {

inline std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

// The centre of a circle that is sure of nothing says nothing.
inline void expect_same_bits(const Circle& found, const Circle& expected) {
  EXPECT_EQ(bits(found.inside), bits(expected.inside));
  EXPECT_EQ(bits(found.outside), bits(expected.outside));
  if (!expected.certain()) return;
  EXPECT_EQ(bits(found.centre.x), bits(expected.centre.x));
  EXPECT_EQ(bits(found.centre.y), bits(expected.centre.y));
}

}  // namespace remodel::test
