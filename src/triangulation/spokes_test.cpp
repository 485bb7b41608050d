#include "triangulation/spokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support.h"
#include "triangulation/test_circle.h"

namespace remodel {
namespace {

// Rings of all lengths, not all around the point: some triangles are flat or clockwise.
TEST(Spokes, GiveTheBitsOfEachCircleAndLength) {
  const unsigned long long seed = test::seed(5);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Spokes spokes;
  int certain = 0, uncertain = 0;
  for (int round = 0; round < 3000 && !HasFailure(); ++round) {
    const std::size_t n = 3 + random() % 20;
    const double size = std::pow(10.0, 200.0 * uniform() - 100.0);
    const Point p{size * uniform(), 10.0 * size * uniform()};
    std::vector<Point> ring;
    for (std::size_t k = 0; k < n; ++k)
      ring.push_back(k % 5 == 4 ? ring.back() : Point{size * uniform(), size * uniform()});
    spokes.begin(p, n);
    for (std::size_t k = 0; k < n; ++k) spokes.set(k, ring[k]);
    spokes.compute();
    ASSERT_EQ(spokes.size(), n);
    for (std::size_t k = 0; k < n; ++k) {
      const Point e1 = ring[k] - p, e2 = ring[(k + 1) % n] - p;
      const Circle circle = certified_circle(p, ring[k], ring[(k + 1) % n]), found = spokes.circle(k);
      test::expect_same_bits(found, circle);
      EXPECT_EQ(test::bits(spokes.length(k)), test::bits(std::sqrt(dot(e1, e1))));
      EXPECT_EQ(test::bits(spokes.squared_shortest(k)),
                test::bits(std::min({dot(e1, e1), dot(e2, e2), squared_distance(e1, e2)})));
      ++(circle.certain() ? certain : uncertain);
    }
  }
  EXPECT_GT(certain, 1000);
  EXPECT_GT(uncertain, 1000);
}

}  // namespace
}  // namespace remodel
