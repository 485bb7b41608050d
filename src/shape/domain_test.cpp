#include "remodel/domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "remodel/error.h"

namespace remodel {
namespace {

const CstAirfoil symmetric{.upper = {0.17, 0.15, 0.15}, .lower = {-0.17, -0.15, -0.15}};

ErrorCode code_of(const CstAirfoil& airfoil, const AirfoilDomainOptions& options) {
  try {
    airfoil_domain(airfoil, options);
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.code();
  }
  ADD_FAILURE() << "no Error";
  return ErrorCode::file;
}

TEST(Curves, PassThroughTheirEndsAndCornersExactly) {
  const Line line{{0.1, 0.7}, {0.3, -1.1}};
  EXPECT_EQ(point_at(line, 0.0), line.from);
  EXPECT_EQ(point_at(line, 1.0), line.to);
  Polyline polyline;
  for (int i = 0; i < 50; ++i) polyline.points.push_back({0.1 * i, std::sin(i)});
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(point_at(polyline, static_cast<double>(i) / 49.0), polyline.points[i]);
  }
  const Point middle = point_at(polyline, 0.5 / 49.0);
  EXPECT_NEAR(middle.x, 0.05, 1e-15);
}

TEST(Curves, ArcsTurnCounterClockwiseForAPositiveSweep) {
  const Arc quarter{
      .centre = {1.0, 2.0}, .radius = 2.0, .start = 0.5 * std::numbers::pi, .sweep = 0.5 * std::numbers::pi};
  EXPECT_EQ(point_at(quarter, 0.0), (Point{1.0, 4.0}));
  EXPECT_EQ(point_at(quarter, 1.0), (Point{-1.0, 2.0}));
  const Arc full{.centre = {0.5, 0.0}, .radius = 25.0};
  EXPECT_EQ(point_at(full, 0.0), point_at(full, 1.0));
  EXPECT_EQ(point_at(full, 0.25), (Point{0.5, 25.0}));
}

TEST(AirfoilDomain, HasThePapersDiscretisation) {
  const Domain domain = airfoil_domain(symmetric, {.points = 100});
  ASSERT_EQ(domain.loops.size(), 2u);
  EXPECT_EQ(domain.curve_count(), 2u);
  EXPECT_EQ(domain.curve(0).name, "airfoil");
  EXPECT_EQ(domain.curve(1).name, "farfield");
  EXPECT_EQ(domain.loop_of(0), 0u);
  EXPECT_EQ(domain.loop_of(1), 1u);
  EXPECT_EQ(domain.loops[0].role, LoopRole::hole);
  EXPECT_EQ(domain.loops[1].role, LoopRole::outer);
  const auto stations = domain.stations(0);
  ASSERT_EQ(stations.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_NEAR(stations[i].t, static_cast<double>(i) / 100.0, 1.2e-16);
    EXPECT_NEAR(domain.at(stations[i]).x, 0.5 * (1.0 + std::cos(2.0 * std::numbers::pi * stations[i].t)),
                1e-15);
  }
  EXPECT_EQ(domain.at(stations[0]), (Point{1.0, 0.0}));
  EXPECT_EQ(domain.at(stations[50]), (Point{0.0, 0.0}));
  EXPECT_EQ(domain.stations(1).size(), 50u);
  EXPECT_EQ(domain.stations(1).front().curve, 1u);
}

TEST(AirfoilDomain, OppositeVerticesAreMirroredToTheLastBitWhateverTheirNumber) {
  for (const int points : {8, 50, 94, 98, 700, 1002, 99998}) {
    const Domain domain =
        airfoil_domain(symmetric, {.points = points, .farfield_points = 2 * points > 100000 ? 51 : points});
    for (std::size_t loop = 0; loop < 2; ++loop) {
      const auto stations = domain.stations(loop);
      for (std::size_t i = 1; i < stations.size(); ++i) {
        const Point p = domain.at(stations[i]);
        const Point q = domain.at(stations[stations.size() - i]);
        ASSERT_EQ(p.x, q.x) << points << " " << i;
        ASSERT_EQ(p.y, -q.y) << points << " " << i;
      }
    }
  }
}

TEST(AirfoilDomain, BothLoopsRunCounterClockwiseWithTheRightAreas) {
  const Domain domain =
      airfoil_domain(symmetric, {.points = 1000, .farfield_radius = 10, .farfield_points = 1000});
  EXPECT_NEAR(signed_area(domain, 1), 100.0 * std::numbers::pi, 0.01);
  double area = 0.0;  // of the airfoil, by the midpoint rule
  for (int i = 0; i < 20000; ++i) {
    const Point p = symmetric.at(0.5 * (i + 0.5) / 20000);
    area += 2.0 * p.y * std::sin(std::numbers::pi * (i + 0.5) / 20000) * 0.5 * std::numbers::pi / 20000;
  }
  EXPECT_NEAR(signed_area(domain, 0), area, 1e-5);
}

TEST(AirfoilDomain, ClosesAnOpenTrailingEdgeFromTheLowerToTheUpperEnd) {
  CstAirfoil open = symmetric;
  open.te_upper = 0.01;
  open.te_lower = -0.005;
  const Domain domain = airfoil_domain(open, {.points = 50});
  EXPECT_EQ(domain.curve_count(), 3u);
  EXPECT_EQ(domain.curve(1).name, "airfoil");
  EXPECT_EQ(domain.loop_of(1), 0u);
  EXPECT_EQ(domain.loop_of(2), 1u);
  const auto stations = domain.stations(0);
  ASSERT_EQ(stations.size(), 51u);
  EXPECT_EQ(domain.at(stations.front()), (Point{1.0, 0.01}));
  EXPECT_EQ(domain.at(stations.back()), (Point{1.0, -0.005}));
  EXPECT_EQ(point_at(domain.curve(1).shape, 1.0), domain.at(stations.front()));
  EXPECT_EQ(domain.stations(1).front().curve, 2u);
}

TEST(AirfoilDomain, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const int points : {-2, 0, 6, 101, 100002})
    EXPECT_EQ(code_of(symmetric, {.points = points}), ErrorCode::argument);
  for (const int points : {-1, 7, 100001}) {
    EXPECT_EQ(code_of(symmetric, {.farfield_points = points}), ErrorCode::argument);
  }
  for (const double radius : {nan, inf, -25.0, 0.0, 1.0}) {
    EXPECT_EQ(code_of(symmetric, {.farfield_radius = radius}), ErrorCode::argument);
  }
  EXPECT_EQ(code_of({.upper = {0.1}, .lower = {0.1}}, {}), ErrorCode::argument);
  EXPECT_EQ(code_of({.upper = {0.1, 0.1}, .lower = {0.1, 0.1, 0.1}}, {}), ErrorCode::argument);
}

TEST(AirfoilDomain, NamesACoefficientThatIsNoNumber) {
  try {
    airfoil_domain({.upper = {0.1, std::numeric_limits<double>::quiet_NaN()}, .lower = {-0.1, -0.1}});
    ADD_FAILURE() << "no Error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::argument);
    EXPECT_NE(std::string(e.what()).find("coefficients"), std::string::npos) << e.what();
  }
}

std::vector<Point> wedge(double gap) {
  return {{1.0, 0.25 + 0.5 * gap},
          {0.7, 0.235},
          {0.3, 0.165},
          {0.1, 0.075},
          {0.0, 0.0},
          {0.1, 0.005},
          {0.3, 0.045},
          {0.7, 0.165},
          {1.0, 0.25 - 0.5 * gap}};
}

Domain domain_around(const std::vector<Curve>& outline) {
  return airfoils_domain({{.name = "wedge", .airfoil = {}, .outline = outline}}, {.farfield_radius = 5});
}

void expect_stations(const Domain& domain, const std::vector<Point>& wanted) {
  EXPECT_NO_THROW(validate(domain));
  const std::vector<Point> points = domain.points(0);
  EXPECT_EQ(points.size(), wanted.size());
  for (const Point p : wanted)
    EXPECT_NE(std::find(points.begin(), points.end(), p), points.end()) << p.x << " " << p.y;
}

// Every point of the file is a station, at its place in the file; the trailing edge is as open as there.
TEST(OutlineAsGiven, GoesThroughThePointsOfTheFile) {
  for (const double gap : {0.0, 0.02})
    for (const OutlineCurve curve : {OutlineCurve::spline, OutlineCurve::polyline}) {
      std::vector<Point> file = wedge(gap);
      const Domain domain = domain_around(outline_of(file, curve, "wedge"));
      EXPECT_EQ(domain.loops[0].curves.size(), gap > 0.0 ? 2u : 1u);
      EXPECT_GT(signed_area(domain, 0), 0.0);
      if (gap == 0.0) file.pop_back();
      expect_stations(domain, file);
      EXPECT_EQ(domain_from_json(domain_to_json(domain), "memory"), domain);
    }
}

// Natural at a sharp trailing edge: a smooth one would turn the spline round there.
TEST(OutlineAsGiven, HasACornerAtASharpTrailingEdge) {
  const std::vector<Curve> curves = outline_of(wedge(0.0), OutlineCurve::spline, "wedge");
  const auto& spline = std::get<Spline>(curves.front().shape);
  EXPECT_TRUE(spline.corner);
  EXPECT_EQ(spline.second.front(), (Point{}));
  EXPECT_EQ(spline.second.back(), (Point{}));
  EXPECT_NE(spline, spline_through(spline.points));
}

// A Gurney flap of the length of 0.03 on the lower side: its four corners stay corners.
TEST(OutlineAsGiven, KeepsTheCornersOfAGurneyFlap) {
  std::vector<Point> file = wedge(0.0);
  file.pop_back();
  for (const Point p : {Point{0.99, 0.2475}, Point{0.99, 0.2175}, Point{1.0, 0.2175}}) file.push_back(p);
  const std::vector<Curve> curves = outline_of(file, OutlineCurve::spline, "wedge");
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_TRUE(std::holds_alternative<Spline>(curves[0].shape));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(std::holds_alternative<Line>(curves[i].shape)) << i;
  expect_stations(domain_around(curves), file);
}

// No corner where there is none: an ellipse.
TEST(OutlineAsGiven, IsSmoothAllAroundARoundBody) {
  std::vector<Point> file;
  for (int i = 0; i < 40; ++i)
    file.push_back(
        {0.5 + 0.5 * std::cos(i * std::numbers::pi / 20), 0.2 * std::sin(i * std::numbers::pi / 20)});
  const std::vector<Curve> curves = outline_of(file, OutlineCurve::spline, "body");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_FALSE(std::get<Spline>(curves[0].shape).corner);
  expect_stations(domain_around(curves), file);
}

TEST(AirfoilDomain, RefusesAFarfieldThatDoesNotContainTheAirfoil) {
  EXPECT_EQ(code_of({.upper = {8.0, 8.0}, .lower = {-1.0, -1.0}}, {.farfield_radius = 2.0}),
            ErrorCode::argument);
}

TEST(OneToOne, HoldsBetweenDesignsOfOneDiscretisationOnly) {
  const CstAirfoil other{.upper = {0.1, 0.2, 0.1, 0.1}, .lower = {-0.1, 0.0, 0.0, 0.0}};
  const Domain a = airfoil_domain(symmetric);
  EXPECT_TRUE(one_to_one(a, airfoil_domain(other)));
  EXPECT_FALSE(one_to_one(a, airfoil_domain(other, {.points = 198})));
  EXPECT_FALSE(one_to_one(a, airfoil_domain(other, {.farfield_points = 51})));
  Domain renamed = a;
  renamed.loops[0].curves[0].name = "wing";
  EXPECT_FALSE(one_to_one(a, renamed));
  Domain swapped = a;
  std::swap(swapped.loops[0], swapped.loops[1]);
  EXPECT_FALSE(one_to_one(a, swapped));
  CstAirfoil open = symmetric;
  open.te_upper = 0.01;
  EXPECT_FALSE(one_to_one(a, airfoil_domain(open)));
}

}  // namespace
}  // namespace remodel
