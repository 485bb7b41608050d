#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "remodel/domain.h"
#include "remodel/error.h"

namespace remodel {
namespace {

Point at(const Spline& spline, double t) {
  return point_at(spline, t);
}

std::vector<Point> circle(int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  points.push_back(points.front());
  return points;
}

TEST(Spline, PassesThroughItsPointsExactly) {
  for (const std::vector<Point>& points :
       {std::vector<Point>{{0, 0}, {1, 0.3}, {1.5, 2}, {4, 1}}, circle(9)}) {
    const Spline spline = spline_through(points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(at(spline, spline.knots[i]), points[i]);
    EXPECT_EQ(at(spline, 0.0), points.front());
    EXPECT_EQ(at(spline, 1.0), points.back());
  }
}

TEST(Spline, ThroughTwoPointsIsTheLine) {
  const Spline spline = spline_through({{1, 2}, {3, 6}});
  for (const double t : {0.1, 0.5, 0.9}) {
    EXPECT_DOUBLE_EQ(at(spline, t).x, 1.0 + 2.0 * t);
    EXPECT_DOUBLE_EQ(at(spline, t).y, 2.0 + 4.0 * t);
  }
}

// Second differences on both sides of each knot agree: twice continuously differentiable, all around if
// closed.
TEST(Spline, IsTwiceContinuouslyDifferentiable) {
  const std::vector<Point> open{{0, 0}, {1, 0.3}, {1.5, 2}, {4, 1}, {5, 5}};
  for (const bool closed : {false, true}) {
    const Spline spline = spline_through(closed ? circle(7) : open);
    const double h = 1e-4;
    const auto wrapped = [&](double t) { return at(spline, closed ? t - std::floor(t) : t); };
    for (std::size_t i = closed ? 0 : 1; i + 1 < spline.knots.size(); ++i) {
      const double t = spline.knots[i];
      const auto second = [&](double from) {
        const Point a = wrapped(from - h), b = wrapped(from), c = wrapped(from + h);
        return Point{(a.x - 2 * b.x + c.x) / (h * h), (a.y - 2 * b.y + c.y) / (h * h)};
      };
      const Point before = second(t - h), after = second(t + h);
      const double scale = std::hypot(after.x, after.y) + 1.0;
      EXPECT_NEAR(before.x, after.x, 0.01 * scale) << i;
      EXPECT_NEAR(before.y, after.y, 0.01 * scale) << i;
    }
  }
}

TEST(Spline, ConvergesToACircleWithTheFourthPower) {
  const auto error = [](int n) {
    const Spline spline = spline_through(circle(n));
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const Point p = at(spline, i / 1000.0);
      worst = std::max(worst, std::abs(std::hypot(p.x, p.y) - 1.0));
    }
    return worst;
  };
  EXPECT_LT(error(32), error(16) / 12.0);
  EXPECT_LT(error(16), 1e-4);
}

TEST(Spline, OfTooFewOrRepeatedPointsIsRefused) {
  EXPECT_THROW(spline_through({{0, 0}}), Error);
  EXPECT_THROW(spline_through({{0, 0}, {0, 0}}), Error);
  EXPECT_THROW(spline_through({{0, 0}, {1, 0}, {0, 0}}), Error);
  EXPECT_THROW(spline_through({{0, 0}, {NAN, 0}}), Error);
}

}  // namespace
}  // namespace remodel
