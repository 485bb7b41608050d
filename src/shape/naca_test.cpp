#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
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

double height_at(const std::vector<Point>& surface, double x) {
  std::size_t i = 1;
  while (i + 1 < surface.size() && surface[i].x < x) ++i;
  const Point a = surface[i - 1], b = surface[i];
  return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
}

// Ordinates of the upper side in chords, from the lists of NACA report 492 (0012-64).
TEST(Naca, ModifiedSectionsHaveTheirPublishedOrdinates) {
  const AirfoilCoordinates section = naca_airfoil("0012-64");
  for (const Point p : {Point{0.0125, 0.01813},
                        {0.025, 0.02453},
                        {0.05, 0.03267},
                        {0.1, 0.0424},
                        {0.2, 0.05293},
                        {0.3, 0.05827},
                        {0.4, 0.06},
                        {0.5, 0.05827},
                        {0.6, 0.0532},
                        {0.7, 0.0448},
                        {0.8, 0.0332},
                        {0.9, 0.01867},
                        {0.95, 0.01027},
                        {1.0, 0.0012}}) {
    EXPECT_NEAR(height_at(section.upper, p.x), p.y, 7e-5) << p.x;
    EXPECT_NEAR(height_at(section.lower, p.x), -p.y, 7e-5) << p.x;
  }
}

// From NACA report 824 and, for the 6A-series, report 903.
TEST(Naca, SixSeriesSectionsHaveTheirPublishedOrdinates) {
  const AirfoilCoordinates a = naca_airfoil("64A010");
  for (const Point p : {Point{0.006, 0.008859},
                        {0.01, 0.011167},
                        {0.05, 0.02331},
                        {0.1, 0.032014},
                        {0.2, 0.042737},
                        {0.4, 0.049954},
                        {0.6, 0.04021},
                        {0.8, 0.021023},
                        {0.95, 0.005404}})
    EXPECT_NEAR(height_at(a.upper, p.x), p.y, 1e-4) << p.x;
  const AirfoilCoordinates b = naca_airfoil("64(2)-015");
  for (const Point p : {Point{0.95, 0.00346}, {0.9, 0.0095}, {0.8, 0.02472}, {0.7, 0.04113}, {0.5, 0.0681}})
    EXPECT_NEAR(height_at(b.upper, p.x), p.y, 2e-4) << p.x;
}

// Of a thin section the mean of both sides is the mean line: that of a = 1 is 0.0552 cl high in the middle.
TEST(Naca, SixSeriesSectionsHaveTheirMeanLines) {
  const auto middle = [](const char* designation, double x) {
    const AirfoilCoordinates s = naca_airfoil(designation);
    return 0.5 * (height_at(s.upper, x) + height_at(s.lower, x)) + s.frame.shear * x;
  };
  EXPECT_NEAR(middle("63-203", 0.5), 0.2 * 0.055159, 1e-4);
  EXPECT_NEAR(middle("63-403", 0.5), 0.4 * 0.055159, 4e-4);
  EXPECT_NEAR(middle("65-203 a=.5", 0.5), 0.2 * std::log(2.0) / (3.0 * std::numbers::pi), 1e-4);
  EXPECT_EQ(naca_airfoil("63-206").upper, naca_airfoil("63-206 a=1").upper);
  EXPECT_NE(naca_airfoil("63-206").upper, naca_airfoil("63-206 a=.8").upper);
  EXPECT_EQ(naca_airfoil("65(1)-412").upper, naca_airfoil("651-412").upper);
}

TEST(Naca, SixSeriesSectionsHaveTheThicknessOfTheirDigits) {
  for (const char* designation :
       {"63-006", "64-012", "65-018", "66-021", "67-015", "63A008", "64A010", "65A012"}) {
    const std::string name = designation;
    const double wanted = 0.01 * std::stoi(name.substr(name.size() - 2));
    double largest = 0.0;
    for (const Point p : naca_airfoil(designation).upper) largest = std::max(largest, 2.0 * p.y);
    EXPECT_NEAR(largest, wanted, 1e-6) << designation;
  }
}

TEST(Naca, RefusesByNameWhatHasNoClosedForm) {
  for (const char* designation : {"0012-07", "0012-61", "0012-04", "66A010", "63-200", "64A210 a=.5",
                                  "63-206 a=2", "63-206 a=x", "747A315", "16-212", "63-20", "62-206"}) {
    try {
      naca_airfoil(designation);
      ADD_FAILURE() << designation;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(designation), std::string::npos) << e.what();
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
