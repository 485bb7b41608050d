#include "step/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support.h"
#include "triangulation/test_circle.h"

namespace remodel {
namespace {

Vertex vertex_at(Point p, double length_scale) {
  Vertex v;
  v.point = p;
  v.length_scale = length_scale;
  return v;
}

struct Corners {
  Vertex a, b, c;
};

// Triangles of all sizes, many of them flat, clockwise, or with corners that coincide.
Corners random_corners(std::mt19937_64& random) {
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double size = std::pow(10.0, 300.0 * uniform() - 150.0), far = random() % 2 == 0 ? 0.0 : 1e3 * size;
  const auto corner = [&] { return Point{far + size * uniform(), far + size * uniform()}; };
  const Point a = corner(), b = random() % 8 == 0 ? a : corner();
  Point c = corner();
  if (random() % 4 == 0) c = {a.x + 0.25 * (b.x - a.x), a.y + 0.25 * (b.y - a.y)};
  return {vertex_at(a, size * uniform()), vertex_at(b, size * uniform()), vertex_at(c, size * uniform())};
}

TEST(Lanes, GiveTheBitsOfACircleAndTheAnswerOfIsGood) {
  const unsigned long long seed = test::seed(17);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  int good = 0, uncertain = 0;
  for (int round = 0; round < 5000 && !HasFailure(); ++round) {
    const QualityBounds bounds({.min_angle_deg = round % 3 == 0 ? 0.0 : 20.0, .max_gradation = 2.0}, 1.0);
    std::vector<Corners> all;
    Lanes lanes;
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      all.push_back(random_corners(random));
      lanes.load(lane, all[lane].a, all[lane].b, all[lane].c);
    }
    lanes.judge(bounds);
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const auto& [a, b, c] = all[lane];
      const Circle circle = certified_circle(a.point, b.point, c.point), found = lanes.circle(lane);
      test::expect_same_bits(found, circle);
      const bool expected = circle.certain() && is_good(a, b, c, circle.squared_radius(), bounds);
      EXPECT_EQ(lanes.good(lane), expected);
      good += expected ? 1 : 0;
      uncertain += circle.certain() ? 0 : 1;
    }
  }
  EXPECT_GT(good, 1000);
  EXPECT_GT(uncertain, 1000);
}

}  // namespace
}  // namespace remodel
