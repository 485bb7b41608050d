#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "remodel/airfoil.h"
#include "remodel/error.h"

namespace remodel {
namespace {

TEST(Naca, SymmetricSectionsFollowTheThicknessFormula) {
  for (const Point p : naca_airfoil("0012").upper) {
    const double x = p.x;
    const double y = 0.6 * (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                            0.1036 * x * x * x * x);
    EXPECT_NEAR(p.y, y, 1e-15);
  }
  const AirfoilCoordinates section = naca_airfoil("0012");
  ASSERT_EQ(section.upper.size(), 201u);
  for (std::size_t i = 0; i < 201; ++i) {
    EXPECT_EQ(section.upper[i].x, section.lower[i].x);
    EXPECT_EQ(section.upper[i].y, -section.lower[i].y);
  }
  EXPECT_EQ(section.upper.back(), (Point{1.0, 0.0}));
}

TEST(Naca, SectionsHaveTheThicknessOfTheirDigits) {
  for (const auto& [digits, thickness] :
       {std::pair{"2412", 0.12}, {"6412", 0.12}, {"4402", 0.02}, {"24012", 0.12}}) {
    const CstFit fit = fit_cst(naca_airfoil(digits), 8);
    EXPECT_LT(fit.max_error, 1e-3) << digits;
    EXPECT_TRUE(surfaces_apart(fit.airfoil)) << digits;
    EXPECT_NEAR(max_thickness(fit.airfoil).value, thickness, 0.001) << digits;
  }
}

// On thin sections: the chord is measured from the foremost point, which on a thick cambered section lies
// visibly above the beginning of the mean line.
TEST(Naca, SectionsHaveTheCamberOfTheirDigits) {
  const auto check = [](const char* digits, double camber, double camber_at) {
    const CstAirfoil airfoil = fit_cst(naca_airfoil(digits), 10).airfoil;
    EXPECT_NEAR(max_camber(airfoil).value, camber, 0.03 * camber) << digits;
    EXPECT_NEAR(max_camber(airfoil).at, camber_at, 0.03) << digits;
  };
  check("2404", 0.02, 0.4);
  check("6404", 0.06, 0.4);
  check("4603", 0.04, 0.6);
  check("24004", 0.0208, 0.2);
  check("25004", 0.0226, 0.25);
  check("23003", 0.0184, 0.15);
}

TEST(Naca, ReflexBendsTheRearOfTheMeanLineUpwards) {
  const auto bend = [](const char* digits) {
    const CstAirfoil airfoil = fit_cst(naca_airfoil(digits), 8).airfoil;
    const auto camber = [&](double x) {
      const double t = std::acos(2.0 * x - 1.0) / (2.0 * std::numbers::pi);
      return 0.5 * (airfoil.at(t).y + airfoil.at(1.0 - t).y);
    };
    return camber(0.4) - 2.0 * camber(0.6) + camber(0.8);
  };
  EXPECT_NEAR(bend("23006"), 0.0, 3e-4);  // a straight line
  EXPECT_NEAR(bend("23106"), 0.04 * 15.793 * 0.00677 * (0.6 - 0.217),
              3e-4);  // k2 (x - m) times the step squared
}

TEST(Naca, MeanLinesAreSmoothWhereTheirTwoPartsMeet) {
  for (const char* digits : {"2412", "6709", "21012", "25012", "22112", "25112"}) {
    const AirfoilCoordinates section = naca_airfoil(digits);
    for (std::size_t i = 20; i + 1 < section.lower.size(); ++i) {
      const Point a = section.lower[i - 1];
      const Point b = section.lower[i];
      const Point c = section.lower[i + 1];
      const double turn = (c.y - b.y) / (c.x - b.x) - (b.y - a.y) / (b.x - a.x);
      ASSERT_LT(std::abs(turn), 0.03) << digits << " at " << b.x;
    }
  }
}

TEST(Naca, RefusesOtherDesignations) {
  for (const char* wrong : {"", "12", "012", "0000", "2400", "2012", "0412", "24l2", "-412", "2 12", "00012",
                            "20012", "26012", "23212", "21112", "23000", "234567", "2412 ", "+2412"}) {
    try {
      naca_airfoil(wrong);
      ADD_FAILURE() << wrong;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::argument) << wrong;
    }
  }
}

}  // namespace
}  // namespace remodel
