#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "remodel/airfoil.h"
#include "support.h"

namespace remodel {
namespace {

CstAirfoil symmetric(int degree, double height) {
  const std::size_t n = static_cast<std::size_t>(degree) + 1;
  return {.upper = std::vector<double>(n, height), .lower = std::vector<double>(n, -height)};
}

TEST(Cst, OppositeParametersShareTheAbscissaToTheLastBit) {
  const CstAirfoil airfoil = symmetric(5, 0.17);
  const auto seed = test::seed(2);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 50000; ++i) {
    const double t = uniform(random);
    const Point p = airfoil.at(t);
    const Point q = airfoil.at(1.0 - t);
    ASSERT_EQ(p.x, q.x) << "t " << t << " seed " << seed;
    ASSERT_EQ(p.y, -q.y) << "t " << t << " seed " << seed;
  }
}

TEST(Cst, EndsAndLeadingEdgeAreExact) {
  const CstAirfoil airfoil{
      .upper = {0.2, 0.1, -0.3}, .lower = {-0.1, 0.05, -0.4}, .te_upper = 0.25, .te_lower = -0.125};
  EXPECT_EQ(airfoil.at(0.0), (Point{1.0, 0.25}));
  EXPECT_EQ(airfoil.at(1.0), (Point{1.0, -0.125}));
  EXPECT_EQ(airfoil.at(0.5), (Point{0.0, 0.0}));
}

TEST(Cst, AbscissaFollowsTheCosineWithFullAccuracyAtTheLeadingEdge) {
  const CstAirfoil airfoil = symmetric(3, 0.1);
  const long double pi = std::numbers::pi_v<long double>;
  for (int i = 1; i < 4000; ++i) {
    const double t = i / 4000.0;
    const long double cosine = std::cos(pi * static_cast<long double>(t));
    const double expected = static_cast<double>(cosine * cosine);
    ASSERT_NEAR(airfoil.at(t).x, expected, 1e-15 * std::max(expected, 1e-300) + 4e-16 * std::sqrt(expected))
        << t;
  }
}

TEST(Cst, AbscissaFallsStrictlyOverTheUpperSurfaceForTheFinestDiscretisation) {
  const CstAirfoil airfoil = symmetric(2, 0.1);
  const int points = 100000;
  double previous = airfoil.at(0.0).x;
  for (int i = 1; i <= points / 2; ++i) {
    const double x = airfoil.at(static_cast<double>(i) / points).x;
    ASSERT_LT(x, previous) << i;
    previous = x;
  }
}

TEST(Cst, EqualCoefficientsGiveTheClassFunctionWhateverTheDegree) {
  for (const int degree : {1, 2, 5, 12, 31, 40}) {
    const CstAirfoil airfoil = symmetric(degree, 0.2);
    for (int i = 0; i <= 100; ++i) {
      const Point p = airfoil.at(i / 200.0);
      ASSERT_NEAR(p.y, 0.2 * std::sqrt(p.x) * (1.0 - p.x), 1e-15) << degree;
    }
  }
}

TEST(Cst, CachedRowsGiveTheSameBitsAsThePoint) {
  const CstAirfoil airfoil{
      .upper = {0.2, 0.1, 0.3, 0.15}, .lower = {-0.1, 0.05, -0.04, 0.01}, .e1 = 0.6, .e2 = 0.9};
  for (int i = 0; i <= 1000; ++i) {
    std::vector<double> row(4);
    const CstStation station = cst_basis(i / 1000.0, 3, 0.6, 0.9, row);
    ASSERT_EQ(airfoil.at(i / 1000.0), (Point{station.x, cst_height(airfoil, station, row)}));
  }
}

TEST(Cst, OtherClassExponentsFollowTheFormula) {
  const CstAirfoil airfoil{.upper = {1.0, 1.0}, .lower = {-1.0, -1.0}, .e1 = 0.75, .e2 = 0.25};
  const Point p = airfoil.at(0.2);
  EXPECT_NEAR(p.y, std::pow(p.x, 0.75) * std::pow(1.0 - p.x, 0.25), 1e-15);
}

TEST(SurfacesApart, HoldsForOrdinaryAirfoilsAndNotForTheSwappedOnes) {
  CstAirfoil airfoil{.upper = {0.17, 0.16, 0.2, 0.1}, .lower = {-0.1, -0.02, 0.05, 0.02}};
  EXPECT_TRUE(surfaces_apart(airfoil));
  std::swap(airfoil.upper, airfoil.lower);
  EXPECT_FALSE(surfaces_apart(airfoil));
}

TEST(SurfacesApart, SeesACrossingThatIsNarrowerThanAnySampling) {
  // D = (x - 1/2)^2 + c in Bernstein form of degree 2: touching at one point for c = 0.
  const auto with_clearance = [](double c) {
    return CstAirfoil{.upper = {0.25 + c, -0.25 + c, 0.25 + c}, .lower = {0.0, 0.0, 0.0}};
  };
  EXPECT_TRUE(surfaces_apart(with_clearance(1e-9)));
  EXPECT_FALSE(surfaces_apart(with_clearance(0.0)));
  EXPECT_FALSE(surfaces_apart(with_clearance(-1e-9)));
}

TEST(SurfacesApart, AllowsATrailingEdgeOfZeroAngleAndNoCrossingBesideIt) {
  EXPECT_TRUE(surfaces_apart({.upper = {0.2, 0.1, 0.05}, .lower = {-0.1, -0.05, 0.05}}));
  EXPECT_TRUE(surfaces_apart({.upper = {0.2, 0.1, 0.05}, .lower = {-0.1, 0.1, 0.05}}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.2, 0.1, 0.05}, .lower = {-0.1, 0.11, 0.05}}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.2, 0.1, 0.05}, .lower = {-0.1, 0.0, 0.0501}}));
  EXPECT_TRUE(surfaces_apart({.upper = {0.2, 0.1, 1e-18}, .lower = {-0.1, 0.0, 0.0}}));
}

TEST(SurfacesApart, RefusesSurfacesThatAreTheSameOrMeetAtTheLeadingEdge) {
  EXPECT_FALSE(surfaces_apart({.upper = {0.1, 0.1}, .lower = {0.1, 0.1}}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.0, 0.1}, .lower = {0.0, -0.1}}));
  EXPECT_FALSE(surfaces_apart({.upper = {-0.1, 0.1, 0.1}, .lower = {0.0, -0.1, -0.1}}));
}

TEST(SurfacesApart, CountsAnOpenTrailingEdge) {
  const CstAirfoil crossing{.upper = {0.2, 0.1, -0.01}, .lower = {-0.1, -0.1, 0.01}};
  EXPECT_FALSE(surfaces_apart(crossing));
  CstAirfoil open = crossing;
  open.te_upper = 0.02;
  open.te_lower = -0.02;
  EXPECT_TRUE(surfaces_apart(open));
  std::swap(open.te_upper, open.te_lower);
  EXPECT_FALSE(surfaces_apart(open));
  CstAirfoil cut = open;  // apart at both ends, crossed between them
  cut.upper[1] = -0.5;
  cut.te_upper = 0.02;
  cut.te_lower = -0.02;
  EXPECT_FALSE(surfaces_apart(cut));
}

TEST(SurfacesApart, RefusesWhatIsNoAirfoil) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(surfaces_apart({}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.1, 0.1}, .lower = {-0.1, -0.1, -0.1}}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.1, nan}, .lower = {-0.1, -0.1}}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.1, inf}, .lower = {-0.1, -0.1}}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.1, 0.1}, .lower = {-0.1, -0.1}, .te_upper = nan}));
  EXPECT_FALSE(surfaces_apart({.upper = {0.1, 0.1}, .lower = {-0.1, -0.1}, .e1 = 0.0}));
  EXPECT_FALSE(surfaces_apart({.upper = {1e308, 0.1}, .lower = {-1e308, -0.1}}));
}

// Sampling can only miss a crossing: what it finds, the decision has to find too. The other way round, the
// decision may be conservative only where the sampled clearance is next to nothing.
TEST(SurfacesApart, AgreesWithDenseSamplingOnRandomAirfoils) {
  const auto seed = test::seed(3);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 0.25);
  int apart = 0;
  for (int k = 0; k < 2000; ++k) {
    CstAirfoil airfoil = symmetric(5, 0.25);
    for (double& c : airfoil.upper) c += normal(random);
    for (double& c : airfoil.lower) c += normal(random);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 1; i < 1000; ++i) {
      const Point u = airfoil.at(0.5 * i / 1000);
      least = std::min(least, (u.y - airfoil.at(1.0 - 0.5 * i / 1000).y) / (std::sqrt(u.x) * (1.0 - u.x)));
    }
    const bool found = surfaces_apart(airfoil);
    apart += found ? 1 : 0;
    const double doubtful = 1e-4;  // a crossing between two samples leaves at most this
    ASSERT_TRUE(found ? least > 0.0 : least < doubtful) << least << ", case " << k << " seed " << seed;
  }
  EXPECT_GT(apart, 100);
  EXPECT_LT(apart, 1900);
}

}  // namespace
}  // namespace remodel
