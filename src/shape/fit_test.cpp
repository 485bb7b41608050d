#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "remodel/airfoil.h"
#include "remodel/error.h"

namespace remodel {
namespace {

AirfoilCoordinates sampled(const CstAirfoil& airfoil, int stations) {
  AirfoilCoordinates result{.name = "sampled", .upper = {}, .lower = {}};
  for (int i = stations; i >= 0; --i) {
    const double t = 0.5 * i / stations;
    result.upper.push_back(airfoil.at(t));
    result.lower.push_back(airfoil.at(1.0 - t));
  }
  return result;
}

ErrorCode code_of_fit(const AirfoilCoordinates& coordinates, int degree) {
  try {
    fit_cst(coordinates, degree);
  } catch (const Error& e) {
    return e.code();
  }
  return ErrorCode::file;
}

TEST(Fit, RecoversTheCoefficientsOfACstAirfoil) {
  const CstAirfoil airfoil{.upper = {0.2, 0.1, 0.3, 0.15, 0.2, 0.1},
                           .lower = {-0.1, 0.05, -0.04, 0.01, -0.1, 0.02}};
  const CstFit fit = fit_cst(sampled(airfoil, 40), 5);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(fit.airfoil.upper[i], airfoil.upper[i], 1e-12);
    EXPECT_NEAR(fit.airfoil.lower[i], airfoil.lower[i], 1e-12);
  }
  EXPECT_LT(fit.max_error, 1e-14);
}

CstAirfoil open_section(double te_upper, double te_lower) {
  return {.upper = {0.2, 0.1, 0.3}, .lower = {-0.1, 0.05, -0.04}, .te_upper = te_upper, .te_lower = te_lower};
}

TEST(Fit, KeepsAnOpenTrailingEdge) {
  const CstAirfoil open = open_section(0.004, -0.003);
  const CstFit fit = fit_cst(sampled(open, 30), 2);
  EXPECT_EQ(fit.airfoil.te_upper, 0.004);
  EXPECT_EQ(fit.airfoil.te_lower, -0.003);
  EXPECT_EQ(fit.gap, 0.007);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fit.airfoil.upper[i], open.upper[i], 1e-12);
  EXPECT_LT(fit.max_error, 1e-14);
}

// The same coefficients; what was closed is an error of the fit.
TEST(Fit, ClosesATrailingEdgeLinearlyWhereAskedTo) {
  const CstAirfoil open = open_section(0.004, -0.003);
  const CstFit fit = fit_cst(sampled(open, 30), 2, TrailingEdge::closed);
  EXPECT_EQ(fit.airfoil.te_upper, 0.0);
  EXPECT_EQ(fit.airfoil.te_lower, 0.0);
  EXPECT_EQ(fit.gap, 0.007);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fit.airfoil.upper[i], open.upper[i], 1e-12);
  EXPECT_NEAR(fit.max_error, 0.004, 1e-14);
}

TEST(Fit, ClosesWhatIsRoundingOrCrossed) {
  for (const auto& [upper, lower] : {std::pair{4e-6, -4e-6}, {-0.002, 0.002}}) {
    const CstFit fit = fit_cst(sampled(open_section(upper, lower), 30), 2);
    EXPECT_EQ(fit.airfoil.te_upper, 0.0);
    EXPECT_EQ(fit.airfoil.te_lower, 0.0);
    EXPECT_NEAR(fit.max_error, std::abs(upper), 1e-12);
  }
}

// A section that is almost closed twice over its chord: its shape function is a polynomial of degree 8.
AirfoilCoordinates pinched_section() {
  AirfoilCoordinates section{.name = "pinched", .upper = {}, .lower = {}};
  for (int i = 0; i <= 60; ++i) {
    const double x = 0.5 * (1.0 - std::cos(3.14159265358979 * i / 60.0));
    const double pinch = (x - 0.3) * (x - 0.8);
    const double height = std::sqrt(x) * (1.0 - x) * (40.0 * pinch * pinch * pinch * pinch + 2e-4);
    section.upper.push_back({x, i == 60 ? 0.0 : height});
    section.lower.push_back({x, i == 60 ? 0.0 : -height});
  }
  return section;
}

TEST(Fit, TakesTheNextDegreeWhoseSurfacesAreApart) {
  const AirfoilCoordinates section = pinched_section();
  ASSERT_FALSE(surfaces_apart(fit_cst(section, 5).airfoil));
  const CstFit fit = fit_cst_apart(section, 5);
  EXPECT_TRUE(surfaces_apart(fit.airfoil));
  EXPECT_GT(fit.airfoil.degree(), 5);
  for (int degree = 6; degree < fit.airfoil.degree(); ++degree)
    EXPECT_FALSE(surfaces_apart(fit_cst(section, degree).airfoil)) << degree;
  const AirfoilCoordinates plain = naca_airfoil("2412");
  EXPECT_EQ(fit_cst_apart(plain, 5).airfoil, fit_cst(plain, 5).airfoil);
}

TEST(Fit, GetsNoWorseWithTheDegreeAndNoBetterThanItsOwnErrors) {
  const AirfoilCoordinates section = naca_airfoil("2412");
  double previous = 1.0;
  for (int degree = 2; degree <= 12; ++degree) {
    const CstFit fit = fit_cst(section, degree);
    EXPECT_LE(fit.rms_error, previous * (1.0 + 1e-9)) << degree;
    EXPECT_LE(fit.rms_error, fit.max_error);
    previous = fit.rms_error;
  }
}

TEST(Fit, RefusesDegreesOutOfRange) {
  for (const int degree : {-1, 0, 1, 13, 1000})
    EXPECT_EQ(code_of_fit(naca_airfoil("0012"), degree), ErrorCode::argument);
}

TEST(Fit, RefusesFewerPointsThanCoefficients) {
  const CstAirfoil airfoil{.upper = {0.2, 0.1}, .lower = {-0.1, -0.1}};
  EXPECT_EQ(code_of_fit(sampled(airfoil, 6), 5), ErrorCode::argument);  // 5 points between the edges
  EXPECT_NO_THROW(fit_cst(sampled(airfoil, 7), 5));
  AirfoilCoordinates bunched = sampled(airfoil, 7);
  for (std::size_t i = 1; i < 7; ++i) bunched.upper[i] = {0.5, 0.1};
  EXPECT_EQ(code_of_fit(bunched, 5), ErrorCode::argument);
  EXPECT_EQ(code_of_fit({}, 5), ErrorCode::argument);
}

TEST(Fit, IsNotBrokenByPointsALittleOutsideTheChord) {
  const CstAirfoil airfoil{.upper = {0.2, 0.1, 0.2}, .lower = {-0.1, -0.1, -0.1}};
  AirfoilCoordinates coordinates = sampled(airfoil, 30);
  coordinates.upper[1].x = -1e-5;
  coordinates.lower.back().x = 1.0 + 1e-5;
  const CstFit fit = fit_cst(coordinates, 4);
  EXPECT_LT(fit.max_error, 0.02);
  EXPECT_NEAR(fit.airfoil.upper[0], 0.2, 1e-2);
}

TEST(Extremes, OfAnAnalyticAirfoilAreWhereTheDerivativeVanishes) {
  // Thickness 0.4 sqrt(x) (1 - x), largest at x = 1/3; camber 0.05 sqrt(x) (1 - x).
  const CstAirfoil airfoil{.upper = {0.25, 0.25, 0.25}, .lower = {-0.15, -0.15, -0.15}};
  const double top = std::sqrt(1.0 / 3.0) * (2.0 / 3.0);
  EXPECT_NEAR(max_thickness(airfoil).value, 0.4 * top, 1e-15);
  EXPECT_NEAR(max_thickness(airfoil).at, 1.0 / 3.0, 1e-6);
  EXPECT_NEAR(max_camber(airfoil).value, 0.05 * top, 1e-15);
  CstAirfoil inverted{.upper = {0.15, 0.15, 0.15}, .lower = {-0.25, -0.25, -0.25}};
  EXPECT_NEAR(max_camber(inverted).value, -0.05 * top, 1e-15);
  EXPECT_NEAR(max_camber(inverted).at, 1.0 / 3.0, 1e-6);
}

TEST(Extremes, CountTheTrailingEdge) {
  const CstAirfoil airfoil{.upper = {0.01, 0.01}, .lower = {-0.01, -0.01}, .te_upper = 0.1, .te_lower = -0.1};
  EXPECT_NEAR(max_thickness(airfoil).value, 0.2, 1e-3);
  EXPECT_GT(max_thickness(airfoil).at, 0.9);
}

}  // namespace
}  // namespace remodel
