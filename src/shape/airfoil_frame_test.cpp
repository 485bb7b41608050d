#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "remodel/airfoil.h"
#include "remodel/error.h"

namespace remodel {
namespace {

double half_thickness(double x) {
  return 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))));
}

// A symmetric section, `half` points a side; `shift` of a spacing off the nose, 0 on it, 0.5 between two
// points.
std::vector<Point> symmetric_section(int half, double shift) {
  std::vector<Point> points{{1.0, 0.0}};
  for (int i = -half; i <= half; ++i) {
    const double s = (i + shift) / half;
    if (std::abs(s) >= 1.0) continue;
    const double x = 0.5 * (1.0 - std::cos(std::numbers::pi * s));
    points.push_back({x, (s < 0.0 ? 1.0 : -1.0) * half_thickness(x)});
  }
  points.push_back({1.0, 0.0});
  return points;
}

std::string text_of(const std::vector<Point>& points, int digits = 15) {
  std::ostringstream text;
  text << "section\n";
  text.precision(digits);
  text << std::fixed;
  for (const Point p : points) text << p.x << " " << p.y << "\n";
  return text.str();
}

std::vector<Point> turned(std::vector<Point> points, double degrees, double size = 1.0, Point to = {}) {
  const double c = std::cos(degrees * std::numbers::pi / 180.0),
               s = std::sin(degrees * std::numbers::pi / 180.0);
  for (Point& p : points) p = to + size * Point{c * p.x - s * p.y, s * p.x + c * p.y};
  return points;
}

double camber_of(const std::string& text) {
  const CstAirfoil airfoil = fit_cst(parse_airfoil(text, "section.dat"), 5).airfoil;
  double camber = 0.0;
  for (double t = 0.0; t < 0.5; t += 0.01)
    camber = std::max(camber, std::abs(0.5 * (airfoil.at(t).y + airfoil.at(1.0 - t).y)));
  return camber;
}

TEST(AirfoilFrame, FitsOfSymmetricFilesAreSymmetricWithAndWithoutAPointOnTheNose) {
  for (const int half : {8, 12, 20, 35, 60, 150, 1000})
    for (const double shift : {0.0, 0.5}) {
      EXPECT_LT(camber_of(text_of(symmetric_section(half, shift))), 1e-6) << half << " " << shift;
      for (const double degrees : {8.0, -25.0, 60.0})
        EXPECT_LT(camber_of(text_of(turned(symmetric_section(half, shift), degrees))), 1e-6)
            << half << degrees;
    }
}

// Points that are not mirrored about the nose: what is left is by how well so many points draw an arc.
TEST(AirfoilFrame, FitsOfASymmetricSectionWithOtherPointsAboveThanBelowHaveNoCamber) {
  for (const auto& [half, camber] : {std::pair{30, 2e-4}, {60, 5e-5}, {150, 1e-5}})
    for (const double shift : {0.1, 0.25, 0.4, 0.49})
      EXPECT_LT(camber_of(text_of(symmetric_section(half, shift))), camber) << half << " " << shift;
}

TEST(AirfoilFrame, SaysByWhatASectionWasTurnedAndFitsTheSame) {
  const std::vector<Point> points = symmetric_section(40, 0.5);
  const CstFit straight = fit_cst(parse_airfoil(text_of(points), "a.dat"), 5);
  EXPECT_TRUE(straight.warnings.empty());
  for (const double degrees : {-8.0, -0.7, 3.0, 30.0}) {
    const CstFit fit = fit_cst(parse_airfoil(text_of(turned(points, degrees)), "a.dat"), 5);
    EXPECT_NEAR(fit.frame.incidence_deg(), -degrees, 1e-3) << degrees;
    for (double t = 0.0; t <= 1.0; t += 0.05)
      EXPECT_NEAR(fit.airfoil.at(t).y, straight.airfoil.at(t).y, 1e-5) << degrees;
    ASSERT_EQ(fit.warnings.size(), 1u) << degrees;
    std::ostringstream said;
    said << std::fixed;
    said.precision(1);
    said << (degrees < 0.0 ? "nose up by " : "nose down by ") << std::abs(degrees) << " degrees";
    EXPECT_NE(fit.warnings[0].find(said.str()), std::string::npos) << fit.warnings[0];
  }
}

// The same section wherever a closed outline begins, whichever way it runs, whatever its place and size.
TEST(AirfoilFrame, IsTheSameWhateverPointAnOutlineBeginsWith) {
  std::vector<Point> points = symmetric_section(30, 0.0);
  for (Point& p : points) p.y += 0.03 * p.x * (1.0 - p.x);
  const AirfoilCoordinates wanted = parse_airfoil(text_of(points), "a.dat");
  std::vector<Point> ring(points.begin(), points.end() - 1);
  std::mt19937 random(7);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Point> other = ring;
    std::rotate(other.begin(), other.begin() + static_cast<int>(random() % ring.size()), other.end());
    if (random() % 2 == 0) other.push_back(other.front());
    if (random() % 2 == 0) std::reverse(other.begin(), other.end());
    other = turned(other, 0.0, 0.01 * static_cast<double>(1 + random() % 10000),
                   {static_cast<double>(random() % 7) - 3.0, 2.0});
    const AirfoilCoordinates found = parse_airfoil(text_of(other, 17), "a.dat");
    ASSERT_EQ(found.upper.size(), wanted.upper.size()) << "seed 7, trial " << trial;
    for (std::size_t i = 0; i < wanted.upper.size(); ++i)
      ASSERT_LT(squared_distance(found.upper[i], wanted.upper[i]), 1e-18) << "seed 7, trial " << trial;
  }
}

TEST(AirfoilFrame, ClosesATrailingEdgeThatIsOpenOrCrossedByRounding) {
  for (const double gap : {4e-14, -6e-16, 9e-6, -9e-6}) {
    std::vector<Point> points = symmetric_section(20, 0.0);
    points.front().y = 0.5 * gap;
    points.back().y = -0.5 * gap;
    const AirfoilOutlines outlines = parse_outlines(text_of(points, 17), "a.dat");
    ASSERT_EQ(outlines.elements.size(), 1u);
    const AirfoilOutline& outline = outlines.elements[0];
    EXPECT_EQ(outline.points.front(), outline.points.back()) << gap;
    EXPECT_NEAR(outline.frame.closed, gap, 1e-3 * std::abs(gap));
    EXPECT_EQ(outline.gap, 0.0);
    EXPECT_EQ(fit_cst(parse_airfoil(text_of(points, 17), "a.dat"), 5).airfoil.te_upper, 0.0);
  }
}

TEST(AirfoilFrame, AnOutlineAsGivenMayGoBackAndForth) {
  std::vector<Point> points = symmetric_section(20, 0.0);
  points.pop_back();
  for (const Point p : {Point{0.99, -0.0014}, Point{0.99, -0.03}, Point{1.0, -0.03}, Point{1.0, 0.0}})
    points.push_back(p);
  EXPECT_EQ(parse_outlines(text_of(points), "gurney.dat").elements[0].points.size(), points.size());
  try {
    parse_airfoil(text_of(points), "gurney.dat");
    ADD_FAILURE() << "no Error";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("as given"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace remodel
