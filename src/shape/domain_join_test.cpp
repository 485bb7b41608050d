#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "remodel/error.h"
#include "remodel/join.h"

namespace remodel {
namespace {

Loop box() {
  return {.role = LoopRole::outer,
          .curves = {{.name = "wall",
                      .shape = Polyline{{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}}},
                      .parameters = Parameters::uniform(8)}}};
}

Loop chain(Shape shape) {
  return {.role = LoopRole::internal,
          .curves = {{.name = "crack", .shape = std::move(shape), .parameters = Parameters::uniform(4)}},
          .open = true};
}

std::string refusal(Domain domain) {
  try {
    join_ends(domain, "file");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(JoinEnds, AnEndMovesOntoAStationThatItMissesByRounding) {
  const Point astray{1.0 + 2e-16, 3e-16};
  for (const Shape& shape : {Shape(Line{astray, {1, 0.5}}), Shape(Polyline{{astray, {0.9, 0.2}, {1, 0.5}}}),
                             Shape(spline_through({astray, {0.9, 0.2}, {1, 0.5}}))}) {
    Domain domain{{box(), chain(shape)}};
    const Joins joins = join_ends(domain, "file");
    EXPECT_EQ(joins.count, 1U);
    EXPECT_NEAR(joins.largest, std::hypot(2.2e-16, 3e-16), 1e-17);
    EXPECT_NE(joins.first.find("(1, 0)"), std::string::npos) << joins.first;
    EXPECT_EQ(domain.points(1).front(), (Point{1, 0}));
    EXPECT_EQ(domain.points(1).back(), (Point{1, 0.5}));
    EXPECT_NO_THROW(validate(domain));
    EXPECT_EQ(join_ends(domain, "file").count, 0U);
  }
}

TEST(JoinEnds, WhatIsMetToTheLastBitOrNotNearStaysAsItIs) {
  Domain domain{{box(), chain(Line{{1, 0}, {1, 0.5}}), chain(Line{{0.5, 1e-6}, {0.5, 0.5}})}};
  const Domain before = domain;
  EXPECT_EQ(join_ends(domain, "file").count, 0U);
  EXPECT_EQ(domain, before);
  Domain astray{{box(), chain(Line{{1, 3e-16}, {1, 0.5}})}};
  const Domain as_it_was = astray;
  EXPECT_EQ(join_ends(astray, "file", 0.0).count, 0U);
  EXPECT_EQ(astray, as_it_was);
}

TEST(JoinEnds, ChainsThatMeetAtOnePointByRoundingAreJoinedThere) {
  const double e = 1e-16;
  Domain domain{{box(), chain(Line{{0.5, 0.5}, {1, 0.5 + e}}), chain(Line{{1 + 2 * e, 0.5 - e}, {1.5, 0.5}}),
                 chain(Line{{1, 0.2}, {1, 0.5}})}};
  const Joins joins = join_ends(domain, "file");
  EXPECT_EQ(domain.points(1).back(), domain.points(2).front());
  EXPECT_EQ(domain.points(1).back(), domain.points(3).back());
  EXPECT_GE(joins.count, 1U);
  EXPECT_NO_THROW(validate(domain));
}

TEST(JoinEnds, AStationMovesOntoTheEndOfAnArc) {
  const Arc arc{.centre = {1, 0.3}, .radius = 0.3, .start = -std::numbers::pi / 2 + 1e-15, .sweep = 1.0};
  Loop wall = box();
  wall.curves[0].shape = Polyline{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}}};
  wall.curves[0].parameters = Parameters::uniform(5);
  Domain domain{{wall, chain(arc)}};
  const Point end = point_at(arc, 0.0);
  ASSERT_FALSE(end == (Point{1, 0}));  // by rounding
  EXPECT_EQ(join_ends(domain, "file").count, 1U);
  EXPECT_EQ(domain.points(1).front(), end);
  EXPECT_NO_THROW(validate(domain));
}

TEST(JoinEnds, WhatCannotBeMovedIsRefusedByBothPlaces) {
  const Arc arc{.centre = {1, 0.5}, .radius = 0.25, .start = 0.1, .sweep = 1.0};
  Arc on = arc;
  on.start = 1.1, on.sweep = 0.5;
  on.centre.x += 1e-15;
  const std::string two = refusal({{box(), chain(arc), chain(on)}});
  EXPECT_NE(two.find("loop 2, curve \"crack\", at ("), std::string::npos) << two;
  EXPECT_NE(two.find("loop 1, curve \"crack\", at ("), std::string::npos) << two;
  const std::string inside = refusal({{box(), chain(Line{{1.1, 3e-16}, {1, 0.5}})}});
  EXPECT_NE(inside.find("(1.1, 3e-16)"), std::string::npos) << inside;
  EXPECT_NE(inside.find("a station there"), std::string::npos) << inside;
}

TEST(JoinEnds, LoopsThatComeAsNearAsRoundingAreRefused) {
  const auto hole = [](double x, double y) {
    return Loop{
        .role = LoopRole::hole,
        .curves = {{.name = "hole",
                    .shape = Polyline{{{x, y}, {x + 0.25, y}, {x + 0.25, y + 0.25}, {x, y + 0.25}, {x, y}}},
                    .parameters = Parameters::uniform(4)}}};
  };
  const std::string found = refusal({{box(), hole(0.5, 0.5), hole(0.75 + 1e-15, 0.5)}});
  EXPECT_NE(found.find("walls that are apart"), std::string::npos) << found;
  EXPECT_EQ(refusal({{box(), hole(0.5, 0.5), hole(0.76, 0.5)}}), "");
}

TEST(JoinEnds, LeavesToValidationWhatItWillRefuse) {
  for (const std::vector<double>& t : {std::vector<double>{0, 3e299}, {0, 1}, {0, 0.5, 0.25}, {0, 0, 0.5}}) {
    Domain domain{{box(), chain(Polyline{{{0.5, 0.5}, {1, 0.5}, {1.2, 0.7}}})}};
    domain.loops[1].curves[0].parameters = t;
    EXPECT_EQ(join_ends(domain, "file").count, 0U);
    EXPECT_THROW(validate(domain), Error);
  }
}

TEST(JoinEnds, RefusesATolerance) {
  Domain domain{{box()}};
  for (const double join : {-1.0, 1e-16, 0.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(join_ends(domain, "file", join), Error) << join;
}

}  // namespace
}  // namespace remodel
