#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/predicates.h"
#include "segments.h"
#include "support.h"

namespace remodel {
namespace {

const CstAirfoil plain{.upper = {0.17, 0.15, 0.15}, .lower = {-0.17, -0.15, -0.15}};

Loop polygon(LoopRole role, std::vector<Point> corners) {
  const std::size_t n = corners.size();
  corners.push_back(corners.front());
  return {.role = role,
          .curves = {{.name = "wall", .shape = Polyline{corners}, .parameters = Parameters::uniform(n)}}};
}

Loop square(LoopRole role, double centre, double half) {
  const double low = centre - half;
  const double high = centre + half;
  return polygon(role, {{low, low}, {high, low}, {high, high}, {low, high}});
}

// The message of the Error that validate throws; empty where it throws none.
std::string refusal(const Domain& domain) {
  try {
    validate(domain);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::geometry);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return {};
}

bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

TEST(Validate, AcceptsAirfoilsInTheirFarfield) {
  EXPECT_EQ(refusal(airfoil_domain(plain)), "");
  CstAirfoil open = plain;
  open.te_upper = 0.001;
  open.te_lower = -0.001;
  EXPECT_EQ(refusal(airfoil_domain(open)), "");
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    for (const int points : {8, 50, 700}) {
      EXPECT_EQ(refusal(airfoil_domain(entry.airfoil(), {.points = points})), "")
          << entry.name << " " << points;
    }
  }
}

TEST(Validate, RefusesAirfoilsWhoseSurfacesCross) {
  CstAirfoil crossed = plain;
  crossed.lower[1] = 0.6;
  const std::string message = refusal(airfoil_domain(crossed));
  EXPECT_TRUE(says(message, "airfoil")) << message;
  EXPECT_TRUE(says(message, "cross")) << message;
  Domain broken = airfoil_domain(plain);
  broken.loops[0].curves[0].shape = CstAirfoil{};
  EXPECT_TRUE(says(refusal(broken), "coefficients"));
}

TEST(Validate, RefusesDomainsWithoutLoopsOrWithTooFewPoints) {
  EXPECT_NE(refusal({}), "");
  EXPECT_NE(refusal({.loops = {Loop{}}}), "");
  EXPECT_TRUE(says(refusal({.loops = {polygon(LoopRole::outer, {{0, 0}, {1, 0}})}}), "2 points"));
  EXPECT_EQ(refusal({.loops = {polygon(LoopRole::outer, {{0, 0}, {1, 0}, {0, 1}})}}), "");
  EXPECT_EQ(refusal({.loops = {polygon(LoopRole::outer, {{0, 0}, {0, 1}, {1, 0}})}}), "");  // clockwise
}

void set_parameter(Curve& curve, std::size_t i, double value) {
  std::vector<double> parameters = curve.parameters;
  parameters[i] = value;
  curve.parameters = std::move(parameters);
}

TEST(Validate, RefusesParametersOutOfOrder) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {0.25, 0.2, 1.0, 1.5, -0.1, nan}) {
    Domain domain{.loops = {square(LoopRole::outer, 0.0, 1.0)}};
    set_parameter(domain.loops[0].curves[0], 2, wrong);
    EXPECT_TRUE(says(refusal(domain), "increasing")) << wrong;
  }
  Domain late{.loops = {square(LoopRole::outer, 0.0, 1.0)}};
  set_parameter(late.loops[0].curves[0], 0, 0.1);
  EXPECT_TRUE(says(refusal(late), "begin with 0"));
}

TEST(Validate, RefusesWhatIsNotFiniteOrBeyondThePredicates) {
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    EXPECT_NE(refusal({.loops = {polygon(LoopRole::outer, {{0, 0}, {wrong, 0}, {0, 1}})}}), "") << wrong;
  }
  EXPECT_NE(refusal({.loops = {polygon(LoopRole::outer, {{0, 0}, {1, 1e-200}, {0, 1}})}}), "");
  Domain arc = airfoil_domain(plain);
  std::get<Arc>(arc.loops[1].curves[0].shape).radius = -25.0;
  EXPECT_TRUE(says(refusal(arc), "radius"));
}

TEST(Validate, RefusesCurvesThatDoNotJoin) {
  Domain domain{.loops = {square(LoopRole::outer, 0.0, 1.0)}};
  std::get<Polyline>(domain.loops[0].curves[0].shape).points.back() = {-1.0, -0.9};
  EXPECT_TRUE(says(refusal(domain), "ends at"));
  CstAirfoil open = plain;
  open.te_upper = 0.01;
  Domain without_line = airfoil_domain(open);
  without_line.loops[0].curves.pop_back();
  EXPECT_TRUE(says(refusal(without_line), "ends at"));
}

TEST(Validate, RefusesLoopsThatCrossTouchOrOverlapThemselves) {
  const auto outer = [](std::vector<Point> corners) {
    return refusal({.loops = {polygon(LoopRole::outer, std::move(corners))}});
  };
  EXPECT_TRUE(says(outer({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), "cross"));          // a bow tie
  EXPECT_TRUE(says(outer({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}), "touch"));  // a corner on a side
  EXPECT_TRUE(says(outer({{0, 0}, {2, 0}, {1, 0}, {1, 1}}), "touch"));          // straight back
  EXPECT_TRUE(says(outer({{0, 0}, {1, 0}, {2, 0}}), "touch"));                  // flat
  EXPECT_TRUE(says(outer({{0, 0}, {0, 2}, {0, 1}, {1, 1}}), "touch"));          // straight back, upright
  EXPECT_TRUE(
      says(outer({{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}), "touch"));  // two corners in one place
  EXPECT_TRUE(says(outer({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "twice"));
  EXPECT_EQ(outer({{0, 0}, {1, 0}, {2, 0}, {1, 1}}), "");  // straight on is fine
}

TEST(Validate, DecidesTouchingToTheLastBit) {
  const double above = std::nextafter(0.1, 1.0);
  const auto with_notch = [](double y) {
    return refusal({.loops = {polygon(LoopRole::outer, {{0, 0.1}, {1, 0.1}, {1, 1}, {0.5, y}, {0, 1}})}});
  };
  EXPECT_NE(with_notch(0.1), "");
  EXPECT_EQ(with_notch(above), "");
}

TEST(Validate, NamesLoopAndCurveOfACrossing) {
  Domain domain{.loops = {square(LoopRole::outer, 0.0, 3.0), square(LoopRole::hole, 0.0, 1.0),
                          square(LoopRole::hole, 1.5, 1.0)}};
  const std::string message = refusal(domain);
  EXPECT_TRUE(says(message, "loop 1")) << message;
  EXPECT_TRUE(says(message, "loop 2")) << message;
  EXPECT_TRUE(says(message, "\"wall\"")) << message;
}

TEST(Validate, WantsRolesToAlternateFromTheOutsideIn) {
  const Loop outer = square(LoopRole::outer, 0.0, 8.0);
  const Loop hole = square(LoopRole::hole, 0.0, 4.0);
  const Loop island = square(LoopRole::outer, 0.0, 2.0);
  EXPECT_EQ(refusal({.loops = {outer, hole, island}}), "");
  EXPECT_EQ(refusal({.loops = {island, hole, outer}}), "");
  EXPECT_EQ(refusal({.loops = {outer, hole, square(LoopRole::outer, 100.0, 2.0)}}), "");  // two domains
  EXPECT_NE(refusal({.loops = {outer, island}}), "");
  EXPECT_NE(refusal({.loops = {hole}}), "");
  EXPECT_NE(refusal({.loops = {outer, hole, square(LoopRole::hole, 0.0, 1.0)}}), "");
  EXPECT_NE(refusal({.loops = {outer, square(LoopRole::hole, 100.0, 2.0)}}), "");
  EXPECT_NE(refusal({.loops = {hole, outer, square(LoopRole::hole, 0.0, 16.0)}}), "");
}

TEST(Validate, AcceptsTheLargestDiscretisation) {
  const Domain domain =
      airfoil_domain(airfoil_catalogue().back().airfoil(), {.points = 100000, .farfield_points = 100000});
  EXPECT_EQ(refusal(domain), "");
}

// All pairs, with the textbook case distinction instead of a product of signs.
bool any_meet_slowly(const std::vector<Side>& sides) {
  const auto on_side = [](const Side& s, Point p) {
    return orient2d(s.from, s.to, p) == 0 && std::min(s.from.x, s.to.x) <= p.x &&
           p.x <= std::max(s.from.x, s.to.x) && std::min(s.from.y, s.to.y) <= p.y &&
           p.y <= std::max(s.from.y, s.to.y);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = 0; j < sides.size(); ++j) {
      const Side& a = sides[i];
      const Side& b = sides[j];
      if (i == j) continue;
      if (a.next == j && (on_side(a, b.to) || on_side(b, a.from))) return true;
      if (a.next == j || b.next == i) continue;
      if (on_side(a, b.from) || on_side(a, b.to)) return true;
      if (orient2d(a.from, a.to, b.from) * orient2d(a.from, a.to, b.to) < 0 &&
          orient2d(b.from, b.to, a.from) * orient2d(b.from, b.to, a.to) < 0) {
        return true;
      }
    }
  }
  return false;
}

TEST(MeetingSides, AgreeWithAllPairsOnRandomPolygonsOfSmallIntegers) {
  const auto seed = test::seed(4);
  std::mt19937_64 random(seed);
  int meeting = 0;
  const int cases = 20000;
  for (int k = 0; k < cases; ++k) {
    const std::size_t n = 3 + random() % 4;
    std::vector<Point> points(n);
    for (Point& p : points) p = {static_cast<double>(random() % 8), static_cast<double>(random() % 8)};
    std::vector<Side> sides;
    for (std::size_t i = 0; i < n; ++i) sides.push_back({points[i], points[(i + 1) % n], (i + 1) % n});
    if (std::any_of(sides.begin(), sides.end(), [](const Side& s) { return s.from == s.to; })) continue;
    const bool slow = any_meet_slowly(sides);
    meeting += slow ? 1 : 0;
    ASSERT_EQ(find_meeting_sides(sides).has_value(), slow) << "case " << k << " seed " << seed;
  }
  EXPECT_GT(meeting, cases / 10);
  EXPECT_LT(meeting, cases * 9 / 10);
}

}  // namespace
}  // namespace remodel
