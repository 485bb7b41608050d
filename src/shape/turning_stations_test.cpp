// Stations of an airfoil of which a share follows how its surface turns.

#include "shape/turning_stations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "remodel/domain.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// The largest angle between neighbouring edges, the trailing edge left out, in degrees.
double sharpest_turn(const CstAirfoil& airfoil, const std::vector<double>& parameters) {
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < parameters.size(); ++i) {
    const Point a = airfoil.at(parameters[i]) - airfoil.at(parameters[i - 1]);
    const Point b = airfoil.at(parameters[i + 1]) - airfoil.at(parameters[i]);
    largest = std::max(largest, std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y)));
  }
  return largest * 180.0 / 3.14159265358979;
}

TEST(TurningStations, AreThoseOfCosineSpacingWithoutAShare) {
  const CstAirfoil airfoil = named_airfoil("naca:2412", 5);
  const std::vector<double> stations = turning_stations(airfoil, 120, 0.0);
  ASSERT_EQ(stations.size(), 120u);
  for (std::size_t i = 0; i < stations.size(); ++i)
    EXPECT_NEAR(stations[i], static_cast<double>(i) / 120, 1e-15);
}

TEST(TurningStations, GoAroundNosesInMoreEdges) {
  const CstAirfoil thin = named_airfoil("naca:2408", 5);
  const double cosine = sharpest_turn(thin, turning_stations(thin, 120, 0.0));
  const double shared = sharpest_turn(thin, turning_stations(thin, 120, 0.2));
  EXPECT_GT(cosine, 25.0);
  EXPECT_LT(shared, 0.4 * cosine);
}

TEST(TurningStations, IncreaseFromTheTrailingEdgeAndHaveTheNose) {
  for (const double share : {0.1, 0.5, 0.9})
    for (const char* name : {"naca:0012", "naca:4412", "rae2822"}) {
      const std::vector<double> stations = turning_stations(named_airfoil(name, 5), 60, share);
      ASSERT_EQ(stations.size(), 60u);
      EXPECT_EQ(stations.front(), 0.0);
      EXPECT_EQ(stations[30], 0.5);
      EXPECT_LT(stations.back(), 1.0);
      for (std::size_t i = 1; i < stations.size(); ++i) EXPECT_GT(stations[i], stations[i - 1]) << name;
    }
}

TEST(TurningStations, OfASymmetricSectionAreSymmetric) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  const Domain domain = airfoil_domain(airfoil, {.points = 100, .turning_share = 0.2});
  const std::vector<Point> points = domain.points(0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_EQ(points[i].x, points[points.size() - i].x);
    EXPECT_EQ(points[i].y, -points[points.size() - i].y);
  }
}

TEST(TurningStations, AShareOutOfRangeIsRefused) {
  const CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  for (const double share : {-0.1, 0.95, std::nan("")})
    EXPECT_THROW(airfoil_domain(airfoil, {.turning_share = share}), Error) << share;
}

}  // namespace
}  // namespace remodel
