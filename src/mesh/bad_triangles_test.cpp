#include "mesh/bad_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace remodel {
namespace {

TEST(BadTriangles, AreSweptFromTheWorstClassDown) {
  BadTriangles bad;
  EXPECT_FALSE(bad.take());
  bad.set(TriangleId{7}, 1);
  bad.set(TriangleId{100'000}, 3);
  bad.set(TriangleId{70}, 3);
  bad.set(TriangleId{8}, 2);
  bad.set(TriangleId{8}, 0);  // good now
  EXPECT_EQ(bad.take(), TriangleId{70});
  bad.set(TriangleId{5}, 3);    // behind the pass: in the next one
  bad.set(TriangleId{200}, 9);  // ahead of it, and worse
  EXPECT_EQ(bad.take(), TriangleId{200});
  EXPECT_EQ(bad.take(), TriangleId{100'000});
  EXPECT_EQ(bad.take(), TriangleId{5});
  EXPECT_EQ(bad.take(), TriangleId{7});
  EXPECT_FALSE(bad.take());
}

// Against a map, with sets and takes in turn: nothing is lost, nothing comes twice, and nothing before what
// was worse when its pass began.
TEST(BadTriangles, AreEachTakenOnce) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const std::size_t slots = std::size_t{1} << (2 + random() % 18);
    BadTriangles bad;
    std::map<std::uint32_t, std::uint8_t> expected;
    for (int step = 0; step < 5000; ++step) {
      if (random() % 2 == 0) {
        const auto slot = static_cast<std::uint32_t>(random() % slots);
        const auto badness = static_cast<std::uint8_t>(random() % 3 == 0 ? 0 : random() % 128);
        bad.set(TriangleId{slot}, badness);
        expected.erase(slot);
        if (badness != 0) expected[slot] = badness;
      } else {
        const TriangleId t = bad.take();
        ASSERT_EQ(static_cast<bool>(t), !expected.empty());
        if (t) {
          ASSERT_EQ(expected.erase(t.index), 1U);
        }
      }
    }
    while (const TriangleId t = bad.take()) {
      ASSERT_EQ(expected.erase(t.index), 1U);
    }
    EXPECT_TRUE(expected.empty());
  }
}

TEST(BadTriangles, ClassesGrowWithBadness) {
  const auto class_of = [](double ratio) { return BadTriangles::class_of(0.3 * ratio, 0.3); };
  EXPECT_EQ(class_of(1.0), 0);
  EXPECT_EQ(BadTriangles::class_of(std::nextafter(1.0, 2.0), 1.0), 1);
  EXPECT_EQ(class_of(1e300), BadTriangles::classes);
  EXPECT_EQ(class_of(INFINITY), BadTriangles::classes);
  EXPECT_EQ(BadTriangles::class_of(1.0, NAN), BadTriangles::classes);  // as is_good() says
  int before = 1;
  for (double ratio = 1.0001; ratio < 1e6; ratio *= 1.05) {
    EXPECT_GE(class_of(ratio), before);
    EXPECT_NEAR(class_of(ratio), 1 + 4 * std::log2(ratio), 1.5);
    before = class_of(ratio);
  }
}

}  // namespace
}  // namespace remodel
