#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/layers.h"
#include "test_layers.h"

namespace remodel::test {
namespace {

std::vector<double> spacings(const std::vector<Point>& points) {
  std::vector<double> result;
  for (std::size_t i = 0; i < points.size(); ++i) result.push_back(distance(points[i], points[(i + 1) % points.size()]));
  return result;
}

TEST(WallStations, HaveTheirDistancesAtBothEdgesAndInBetween) {
  Domain domain = airfoil_domain(named_airfoil("naca:0012", 8));
  const WallSpacing spacing{.leading_edge = 0.001, .trailing_edge = 0.002, .most = 0.01};
  space_walls(domain, spacing);
  const std::vector<double>& t = domain.loops[0].curves[0].parameters;
  EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
  ASSERT_TRUE(std::binary_search(t.begin(), t.end(), 0.5)) << "the nose is a station";
  const std::vector<double> between = spacings(domain.points(0));
  const auto nose = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), 0.5) - t.begin());
  EXPECT_NEAR(between[nose], 0.001, 0.0002);
  EXPECT_NEAR(between[0], 0.002, 0.0003);
  EXPECT_NEAR(between.back(), 0.002, 0.0003);
  EXPECT_NEAR(*std::max_element(between.begin(), between.end()), 0.01, 0.0003);
  for (std::size_t i = 0; i + 1 < between.size(); ++i)
    EXPECT_LT(std::max(between[i] / between[i + 1], between[i + 1] / between[i]), 1.15) << i;
}

TEST(WallStations, ABaseIsDividedByTheSpacingOfCorners) {
  CstAirfoil airfoil = named_airfoil("naca:0012", 8);
  airfoil.te_upper = 0.005, airfoil.te_lower = -0.005;
  Domain domain = airfoil_domain(airfoil);
  space_walls(domain, {.trailing_edge = 0.0025});
  EXPECT_EQ(domain.loops[0].curves[1].parameters.size(), 4);
  validate(domain);
}

TEST(WallStations, PolylinesKeepTheirCorners) {
  Domain domain;
  const std::vector<Point> corners{{0, 0}, {1, 0}, {1, 0.1}, {0.3, 0.12}, {0, 0}};
  domain.loops = {{.role = LoopRole::hole,
                   .curves = {{.name = "wall", .shape = Polyline{corners}, .parameters = Parameters::uniform(4)}}},
                  box(10)};
  space_walls(domain, {});
  const std::vector<Point> points = domain.points(0);
  for (const Point corner : corners) EXPECT_EQ(std::count(points.begin(), points.end(), corner), 1);
  EXPECT_GT(points.size(), 250);
}

TEST(WallStations, RefuseDistancesThatAreNone) {
  Domain domain = airfoil_domain(named_airfoil("naca:0012", 8));
  EXPECT_THROW(space_walls(domain, {.leading_edge = 0.0}), Error);
  EXPECT_THROW(space_walls(domain, {.most = -1.0}), Error);
  EXPECT_THROW(space_walls(domain, {.growth = 2.0}), Error);
  EXPECT_THROW(space_walls(domain, {}, {"wing"}), Error);
}

}  // namespace
}  // namespace remodel::test
