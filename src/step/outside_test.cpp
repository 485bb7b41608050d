// What lies outside the domain, in holes and between the outermost boundary and the hull, is as Delaunay as
// the domain after every step that replaces anything: refinement and insertion go through it.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

// Polygons whose corners move, each by itself.
class Designs {
 public:
  Designs(std::mt19937_64& random, Point origin) : random_(random), origin_(origin) {}

  void add(LoopRole role, std::vector<Point> corners) {
    for (Point& p : corners) p = p + origin_;
    parts_.push_back({role, std::move(corners)});
  }

  Domain domain() const {
    Domain result;
    for (const auto& [role, corners] : parts_)
      result.loops.push_back(test::polygon(role, "part " + std::to_string(result.loops.size()), corners));
    return result;
  }

  // Moves the corners of some by a little, so that most steps are full adjustments, or by more.
  void next() {
    const double most = random_() % 4 == 0 ? 0.02 : 0.002;
    for (auto& [role, corners] : parts_)
      if (random_() % 5 < 2) jiggle(corners, most);
  }

 private:
  void jiggle(std::vector<Point>& corners, double most) {
    for (Point& p : corners)
      p = p + Point{test::uniform(random_, -most, most), test::uniform(random_, -most, most)};
  }

  std::mt19937_64& random_;
  Point origin_;
  std::vector<std::pair<LoopRole, std::vector<Point>>> parts_;
};

// Four points a side: the sides are nearly straight.
std::vector<Point> square(Point low, double size) {
  std::vector<Point> corners;
  for (int i = 0; i < 12; ++i) {
    const double s = (i % 3) / 3.0;
    const Point p = i < 3 ? Point{s, 0} : i < 6 ? Point{1, s} : i < 9 ? Point{1 - s, 1} : Point{0, 1 - s};
    corners.push_back(low + size * p);
  }
  return corners;
}

std::vector<Point> star(Point centre, double radius) {
  std::vector<Point> corners;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? radius : 0.5 * radius, angle = 0.628318 * i;
    corners.push_back(centre + Point{r * std::cos(angle), r * std::sin(angle)});
  }
  return corners;
}

void three_stars(Designs& designs) {
  designs.add(LoopRole::outer, square({0, 0}, 1.0));
  for (const Point centre : {Point{0.25, 0.3}, Point{0.7, 0.35}, Point{0.45, 0.75}})
    designs.add(LoopRole::hole, star(centre, 0.12));
}

// Between them lies what is outside of both, as it is outside of all.
void two_islands(Designs& designs) {
  designs.add(LoopRole::outer, square({0, 0}, 1.0));
  designs.add(LoopRole::outer, star({1.4, 0.5}, 0.3));
  designs.add(LoopRole::outer, square({1.15, 0.9}, 0.4));
}

// Between a hole's edge and the islands in it.
void islands_in_a_hole(Designs& designs) {
  designs.add(LoopRole::outer, square({0, 0}, 1.0));
  designs.add(LoopRole::hole, square({0.1, 0.1}, 0.8));
  designs.add(LoopRole::outer, star({0.35, 0.4}, 0.15));
  designs.add(LoopRole::outer, star({0.65, 0.65}, 0.15));
}

// Stars so near to the sides that these are split: Steiner vertices on the hull.
void stars_at_the_rim(Designs& designs) {
  designs.add(LoopRole::outer, {{0, 0}, {0.5, -0.02}, {1, 0}, {1, 1}, {0, 1}});
  for (const Point centre : {Point{0.3, 0.13}, Point{0.86, 0.45}, Point{0.45, 0.86}, Point{0.12, 0.6}})
    designs.add(LoopRole::hole, star(centre, 0.1));
}

std::size_t stale_circles(const Triangulation& triangulation) {
  std::size_t stale = 0;
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (!t.alive() || t.ghost()) continue;
    stale += !(triangulation.circle_of(t.vertex[0], t.vertex[1], t.vertex[2]) == t.circle);
  }
  return stale;
}

// Hull vertices that could be relocated are rare: it takes 47 chains of three stars to meet one.
struct OutsideCase {
  const char* name;
  void (*parts)(Designs&);
  int chains = 6;
};
constexpr std::array<OutsideCase, 4> outside_cases{{{"ThreeStars", three_stars, 48},
                                                    {"TwoIslands", two_islands},
                                                    {"IslandsInAHole", islands_in_a_hole},
                                                    {"StarsAtTheRim", stars_at_the_rim}}};
class Outside : public testing::TestWithParam<std::size_t> {};

// With the origin in a corner, and far to every side.
TEST_P(Outside, IsDelaunayAfterEveryReplacement) {
  const auto seed = test::seed(611);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  int adjusted = 0, replaced = 0;
  const OutsideCase& tested = outside_cases[GetParam()];
  for (int chain = 0; chain < tested.chains * test::effort(); ++chain) {
    constexpr std::array<Point, 3> places{{{0, 0}, {3, 2}, {-2, -4}}};
    Designs designs(random, places[static_cast<std::size_t>(chain) % places.size()]);
    tested.parts(designs);
    Mesh mesh = test::generated(designs.domain(), {.gradation = 2.0});
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE("chain " + std::to_string(chain) + ", step " + std::to_string(step));
      designs.next();
      const Method method = random() % 8 == 0 ? Method::general : Method::automatic;
      RemodelResult result;
      try {
        result = remodel(mesh, designs.domain(), {.method = method, .strategy = Strategy::chain});
      } catch (const Error&) {
        break;  // corners were moved across each other
      }
      ASSERT_EQ(mesh.quick_check(), "");
      ASSERT_EQ(mesh.data().triangulation.check_topology(), "");
      EXPECT_FALSE(result.regenerated) << result.reason;
      result.full_adjustment ? ++adjusted : ++replaced;
      if (!result.full_adjustment) {
        ASSERT_EQ(mesh.data().triangulation.check(), "");
        ASSERT_EQ(stale_circles(mesh.data().triangulation), 0U);
      }
    }
  }
  EXPECT_GT(adjusted, 20);
  EXPECT_GT(replaced, 20);
}

// Steps that keep connectivity take what lies outside of the domain off the hull; others put it back.
TEST_P(Outside, IsATriangulationWhateverTheStrategies) {
  const auto seed = test::seed(613);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  int held = 0;
  for (int chain = 0; chain < 4 * test::effort(); ++chain) {
    Designs designs(random, {0, 0});
    outside_cases[GetParam()].parts(designs);
    Mesh mesh = test::generated(designs.domain(), {.gradation = 2.0, .refine_angle_deg = 32.0});
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE("chain " + std::to_string(chain) + ", step " + std::to_string(step));
      designs.next();
      const RemodelOptions options{.strategy = strategies()[random() % strategies().size()].strategy};
      try {
        held += remodel(mesh, designs.domain(), options).held;
      } catch (const Error&) {
        break;  // corners were moved across each other
      }
      ASSERT_EQ(mesh.quick_check(), "");
      ASSERT_EQ(mesh.data().triangulation.check_topology(), "");
    }
  }
  EXPECT_GT(held, 10);
}

INSTANTIATE_TEST_SUITE_P(Of, Outside, testing::Range(std::size_t{0}, outside_cases.size()),
                         [](const auto& tested) { return outside_cases[tested.param].name; });

// Four points; the lowest is moved up until the hull is dented below it.
TEST(Hull, IsConvexAgainAndRecoveryEndsWhereItIsNot) {
  Triangulation t;
  t.start({0, 0}, {4, 0}, {2, 1});
  const VertexId low = t.insert({2, -0.5}, TriangleId{0}).vertex;
  t.move(low, {2, 0.5}, 1.0);
  t.for_each_corner(low, [&](Corner c) {
    if (!t[c.triangle].ghost()) t.refresh_circle(c.triangle);
  });
  ASSERT_EQ(t.check_topology(), "");
  const VertexId left{1}, right{2};
  EXPECT_NE(t.constrain(left, right).kind, ConstrainResult::Kind::done);
  EXPECT_TRUE(t.restore_hull());
  EXPECT_EQ(t.check(), "");
  EXPECT_EQ(t.constrain(left, right).kind, ConstrainResult::Kind::done);
  EXPECT_TRUE(t.restore_hull());
  EXPECT_EQ(t.check(), "");
}

// Thousands of points on a circle, then moved by a little: dents everywhere, in one pass.
TEST(Hull, OfManyPointsIsConvexAgain) {
  const auto seed = test::seed(641);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  constexpr int n = 3999;
  const auto on_circle = [](int i, double radius) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    return Point{radius * std::cos(angle), radius * std::sin(angle)};
  };
  Triangulation t;
  t.start(on_circle(0, 1.0), on_circle(n / 3, 1.0), on_circle(2 * n / 3, 1.0));
  t.insert({0, 0}, TriangleId{0});
  VertexId last{1};
  for (int i = 0; i < n; ++i) last = t.insert(on_circle(i, 1.0), t.star(last).triangle).vertex;
  EXPECT_TRUE(t.restore_hull());
  ASSERT_EQ(t.check(), "");
  // Farther than a chord of two sides lies inside the circle.
  for (std::uint32_t v = 1; v < t.vertex_slots(); ++v)
    t.move(VertexId{v}, (1.0 + 1e-5 * test::uniform(random, -1.0, 1.0)) * t.point(VertexId{v}), 1.0);
  std::vector<TriangleId> all;
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
    if (!t[TriangleId{i}].alive() || t[TriangleId{i}].ghost()) continue;
    t.refresh_circle(TriangleId{i});
    all.push_back(TriangleId{i});
  }
  ASSERT_EQ(t.check_topology(), "");
  EXPECT_TRUE(t.restore_hull());
  t.restore_delaunay(all);
  EXPECT_EQ(t.check(), "");
}

// A star: the triangles between its tips come off the hull, and come back.
TEST(Hull, OpensUpToConstrainedEdgesAndIsConvexAgain) {
  Mesh mesh = generate({{test::polygon(LoopRole::outer, "star", star({0, 0}, 1.0))}}).mesh;
  Triangulation& t = mesh.data().triangulation;
  const auto outside = [&] {
    int count = 0;
    for (std::uint32_t i = 0; i < t.triangle_slots(); ++i)
      if (const Triangle& one = t[TriangleId{i}]; one.alive() && !one.ghost())
        count += one.region == Region::outside ? 1 : 0;
    return count;
  };
  const int before = outside();
  ASSERT_GE(before, 5);
  EXPECT_TRUE(t.open_hull());
  EXPECT_EQ(t.check_topology(), "");
  EXPECT_EQ(outside(), 0);
  EXPECT_FALSE(t.open_hull());
  EXPECT_TRUE(t.restore_hull());
  EXPECT_EQ(t.check(), "");
  EXPECT_EQ(outside(), before);
}

// A corner of the outline moves in at once, and further than in place. Wherever the outline lies: no place
// of a hull vertex is judged by the infinite one's.
TEST(Hull, IsConvexWhereALostCornerMovedIn) {
  int lost = 0;
  for (const Point origin : {Point{0, 0}, Point{-0.5, 3}, Point{-0.5, 0.3}, Point{2, 5}})
    for (double y = 0.02; y < 0.3; y += 0.02) {
      const auto outline = [&](double corner) {
        std::vector<Point> corners{{0, 0}, {0.5, corner}, {1, 0}, {1, 1}, {0, 1}};
        for (Point& p : corners) p = p + origin;
        return Domain{{test::polygon(LoopRole::outer, "outer", corners, 4)}};
      };
      SCOPED_TRACE("origin " + std::to_string(origin.y) + ", to " + std::to_string(y));
      Mesh mesh = test::generated(outline(-0.05), {.gradation = 2.0});
      const RemodelResult result = remodel(mesh, outline(y), {.strategy = Strategy::chain});
      EXPECT_FALSE(result.regenerated) << result.reason;
      lost += result.full_adjustment ? 0 : 1;
      if (result.full_adjustment) continue;
      ASSERT_EQ(mesh.quick_check(), "");
      ASSERT_EQ(mesh.data().triangulation.check(), "");
    }
  EXPECT_GT(lost, 20);
}

// A corner of the outline moves in place far enough to dent the hull; what comes next lies beyond the dent.
TEST(Hull, IsConvexAgainWhereACornerMovedIn) {
  const auto outline = [](double y) {
    return Domain{
        {test::polygon(LoopRole::outer, "outer",
                       {{0, 0}, {0.5, y}, {1, 0}, {1.05, 0.5}, {1, 1}, {0.5, 1.05}, {0, 1}, {-0.05, 0.5}})}};
  };
  Mesh mesh = test::generated(outline(-0.01), {.min_angle_deg = 20.0, .max_gradation = 2.0});
  bool dented = false;
  for (double y = -0.01; y < 0.02; y += 0.002) {
    const RemodelResult result = remodel(mesh, outline(y), {.strategy = Strategy::chain});
    dented |= result.full_adjustment && y > 0.0;
    ASSERT_EQ(mesh.quick_check(), "");
  }
  EXPECT_TRUE(dented);
  Domain larger{{test::rectangle(LoopRole::outer, "outer", {-0.2, -0.2}, {1.2, 1.2}, 3)}};
  larger.loops.push_back(test::square_hole(0.5, -0.1, 0.02, 1));
  const RemodelResult result = remodel(mesh, larger, {.strategy = Strategy::chain});
  EXPECT_FALSE(result.regenerated) << result.reason;
  EXPECT_EQ(mesh.quick_check(), "");
  EXPECT_EQ(mesh.data().triangulation.check(), "");
}

}  // namespace
}  // namespace remodel
