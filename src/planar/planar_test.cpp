#include "remodel/planar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"

namespace remodel {
namespace {

using Segments = std::vector<PlanarGraph::Segment>;

// A graph of closed polygons.
PlanarGraph polygons(const std::vector<std::vector<Point>>& all, std::vector<Point> holes = {}) {
  PlanarGraph graph;
  graph.holes = std::move(holes);
  for (const auto& polygon : all) {
    const auto first = static_cast<std::uint32_t>(graph.points.size());
    const auto n = static_cast<std::uint32_t>(polygon.size());
    graph.points.insert(graph.points.end(), polygon.begin(), polygon.end());
    for (std::uint32_t i = 0; i < n; ++i) graph.segments.push_back({first + i, first + (i + 1) % n});
  }
  return graph;
}

std::vector<Point> square(double x, double y, double half) {
  return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
}

void add_segment(PlanarGraph& graph, Point a, Point b, int marker = 0) {
  const auto first = static_cast<std::uint32_t>(graph.points.size());
  graph.points.insert(graph.points.end(), {a, b});
  graph.segments.push_back({first, first + 1, marker});
}

double area(const Domain& domain) {
  return check(generate(domain, {.min_angle_deg = 0.0, .max_gradation = 1e9}).mesh.freeze()).area;
}

// A mesh that is done, valid for the independent checker with its design, and for the quick check.
Mesh meshed(const Domain& domain) {
  validate(domain);
  GenerateResult result = generate(domain);
  EXPECT_EQ(result.stopped, Stopped::done);
  EXPECT_EQ(result.mesh.quick_check(), "");
  const QualityOptions& options = result.mesh.options();
  const CheckResult checked = check(result.mesh.freeze(), {.min_angle_deg = options.min_angle_deg,
                                                           .max_gradation = options.max_gradation,
                                                           .design = &result.mesh.domain()});
  for (const Violation& violation : checked.violations)
    ADD_FAILURE() << violation.rule << ": " << violation.detail;
  EXPECT_GE(checked.min_held_angle_deg, 30.0 - 1e-6);
  const Mesh restored = Mesh::restore(result.mesh.state(), "state");
  EXPECT_TRUE(restored.state() == result.mesh.state());
  EXPECT_EQ(restored.freeze().curve, result.mesh.freeze().curve);
  return std::move(result.mesh);
}

bool has_curve(const Domain& domain, const std::string& name) {
  for (std::size_t i = 0; i < domain.curve_count(); ++i)
    if (domain.curve(i).name == name) return true;
  return false;
}

PlanarFindings findings_of(const PlanarGraph& graph) {
  PlanarFindings findings;
  planar_domain(graph, "graph", Crossings::insert, &findings);
  return findings;
}

TEST(Planar, APolygonWithAHoleIsTwoLoops) {
  const PlanarGraph graph = polygons({square(0, 0, 2), square(0, 0, 1)}, {{0.1, 0.2}});
  const Domain domain = planar_domain(graph, "graph");
  ASSERT_EQ(domain.loops.size(), 2U);
  for (const Loop& loop : domain.loops) {
    EXPECT_FALSE(loop.open);
    EXPECT_TRUE(loop.role == LoopRole::left || loop.role == LoopRole::right);
    EXPECT_EQ(loop.curves.front().name, "boundary");
  }
  EXPECT_DOUBLE_EQ(area(domain), 12.0);
  meshed(domain);
}

TEST(Planar, WithoutAHolePointAnInnerPolygonIsAConstraint) {
  const Domain domain = planar_domain(polygons({square(0, 0, 2), square(0, 0, 1)}), "graph");
  EXPECT_DOUBLE_EQ(area(domain), 16.0);
  ASSERT_EQ(domain.loops.size(), 2U);
  EXPECT_EQ(std::count_if(domain.loops.begin(), domain.loops.end(),
                          [](const Loop& loop) { return loop.role == LoopRole::internal; }),
            1);
  const Mesh mesh = meshed(domain);
  const FrozenMesh frozen = mesh.freeze();
  EXPECT_EQ(frozen.boundaries.size(), 2U);
}

TEST(Planar, ACrackIsAnOpenChainWithTheMeshOnBothSides) {
  PlanarGraph graph = polygons({square(0, 0, 2)});
  add_segment(graph, {-0.5, 0.1}, {0.7, 0.3}, 7);
  const Domain domain = planar_domain(graph, "graph");
  ASSERT_EQ(domain.loops.size(), 2U);
  EXPECT_TRUE(has_curve(domain, "7"));
  EXPECT_TRUE(
      std::any_of(domain.loops.begin(), domain.loops.end(), [](const Loop& loop) { return loop.open; }));
  EXPECT_DOUBLE_EQ(area(domain), 16.0);
  meshed(domain);
}

TEST(Planar, ACrackFromTheBoundaryJoinsItThere) {
  PlanarGraph graph = polygons({square(0, 0, 2)});
  add_segment(graph, {-2, 0}, {0, 0});       // ends on a side of the square: points on segments
  add_segment(graph, {0, 0}, {1.5, 0.001});  // shares a point with it, at a small angle to the next
  add_segment(graph, {0, 0}, {1.5, 0.2});
  const PlanarFindings findings = findings_of(graph);
  EXPECT_EQ(findings.points_on_segments, 1U);
  EXPECT_EQ(findings.duplicate_points, 2U);
  const Domain domain = planar_domain(graph, "graph");
  EXPECT_DOUBLE_EQ(area(domain), 16.0);
  const Mesh mesh = meshed(domain);
  EXPECT_GT(generate(domain).exempt_triangles, 0U);
}

TEST(Planar, CrossingSegmentsAreSplitAtTheCrossing) {
  const PlanarGraph graph = polygons({square(0, 0, 2), square(1.5, 1.5, 2)});
  PlanarFindings findings;
  const Domain domain = planar_domain(graph, "graph", Crossings::insert, &findings);
  EXPECT_EQ(findings.crossings, 2U);
  EXPECT_DOUBLE_EQ(area(domain), 16.0 + 16.0 - 2.5 * 2.5);
  meshed(domain);
  try {
    planar_domain(graph, "graph", Crossings::refuse);
    ADD_FAILURE();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("segment"), std::string::npos);
    EXPECT_NE(message.find("(2, -0.5)"), std::string::npos) << message;
  }
}

TEST(Planar, OverlappingSegmentsBecomeOne) {
  PlanarGraph graph = polygons({square(0, 0, 2)});
  add_segment(graph, {-1, -2}, {1, -2}, 3);  // on a side
  add_segment(graph, {-1, 0}, {1, 0});
  add_segment(graph, {0.5, 0}, {-3, 0});  // over the one before, and out of the square
  add_segment(graph, {0.25, 0.25}, {0.25, 0.25});
  const PlanarFindings findings = findings_of(graph);
  EXPECT_EQ(findings.empty_segments, 1U);
  EXPECT_EQ(findings.outside_segments, 1U);
  EXPECT_EQ(findings.overlaps, 2U);
  const Domain domain = planar_domain(graph, "graph");
  EXPECT_DOUBLE_EQ(area(domain), 16.0);
  EXPECT_TRUE(has_curve(domain, "3"));
  meshed(domain);
}

TEST(Planar, ABowTieIsTwoPartsThatTouch) {
  const Domain domain = planar_domain(polygons({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}), "graph");
  EXPECT_DOUBLE_EQ(area(domain), 2.0);
  meshed(domain);
}

TEST(Planar, APointOfNoSegmentIsKeptWhereTheDomainIs) {
  PlanarGraph graph = polygons({square(0, 0, 2), square(0, 0, 0.5)}, {{0, 0}});
  graph.points.insert(graph.points.end(), {{1.2, 1.3}, {0.1, 0.1}, {5, 5}});
  const PlanarFindings findings = findings_of(graph);
  EXPECT_EQ(findings.outside_points, 2U);
  const Mesh mesh = meshed(planar_domain(graph, "graph"));
  const FrozenMesh frozen = mesh.freeze();
  EXPECT_EQ(std::count(frozen.points.begin(), frozen.points.end(), Point{1.2, 1.3}), 1);
}

TEST(Planar, OutlinesThatDoNotCloseAreRefused) {
  PlanarGraph graph = polygons({square(0, 0, 2)});
  graph.segments.pop_back();
  EXPECT_THROW(planar_domain(graph, "graph"), Error);
  EXPECT_THROW(planar_domain(polygons({square(0, 0, 2)}, {{0, 0}}), "graph"), Error);
  EXPECT_THROW(planar_domain({}, "graph"), Error);
  PlanarGraph line;
  for (int i = 0; i < 4; ++i) add_segment(line, {1.0 * i, 1.0 * i}, {i + 1.0, i + 1.0});
  EXPECT_THROW(planar_domain(line, "graph"), Error);
  PlanarGraph astray = polygons({square(0, 0, 2)});
  astray.segments.push_back({0, 99});
  EXPECT_THROW(planar_domain(astray, "graph"), Error);
  PlanarGraph nan = polygons({square(0, 0, 2)});
  nan.points[1].x = std::nan("");
  EXPECT_THROW(planar_domain(nan, "graph"), Error);
}

// Houses in a row at the coordinates of a map, each with corners of its own that differ by rounding: the
// domain is that of houses that share theirs.
TEST(Planar, WallsThatDifferByRoundingAreOne) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Point base{411960.25, 5711970.5};
    const auto houses = [&](double error) {
      std::vector<std::vector<Point>> all{square(base.x, base.y, 100)};
      std::vector<Point> holes;
      const auto off = [&] { return error * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0); };
      for (int i = 0; i < 5; ++i) {
        all.push_back(square(base.x + 8 * i, base.y, 4));
        for (Point& p : all.back()) p = {p.x + off(), p.y + off()};
        holes.push_back({base.x + 8 * i, base.y});
      }
      return polygons(all, holes);
    };
    PlanarFindings findings;
    const Domain exact = planar_domain(houses(0.0), "graph");
    const Domain domain = planar_domain(houses(4e-9), "graph", Crossings::insert, &findings);
    EXPECT_EQ(findings.crossings, 0U);
    EXPECT_GT(findings.joins.count, 4U);
    EXPECT_LT(findings.joins.largest, 1.2e-8);
    EXPECT_EQ(domain.loops.size(), exact.loops.size());
    EXPECT_NEAR(area(domain), area(exact), 1e-5);
    meshed(domain);
  }
}

TEST(Planar, AToleranceOfNothingLeavesPointsApart) {
  PlanarGraph graph = polygons({square(0, 0, 2)});
  graph.points.push_back({-2.0 - 1e-15, -2.0});
  graph.segments.back().to = 4;
  EXPECT_NO_THROW(planar_domain(graph, "graph"));
  try {
    planar_domain(graph, "graph", Crossings::insert, nullptr, 0.0);
    ADD_FAILURE();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("open at (-2, -2), "), std::string::npos) << message;
    EXPECT_NE(message.find("8.88e-16 away"), std::string::npos) << message;
  }
}

TEST(Planar, RegionsNameThePartsThatTheirPointsLieIn) {
  PlanarGraph graph = polygons({square(0, 0, 2), square(0, 0, 1), square(0, 0, 0.25)}, {{0, 0}});
  graph.regions = {{{0.5, 0.5}, "inner"}, {{-0.5, 0.5}, "again"}, {{0, 0}, "hole"}, {{9, 9}, "outside"}};
  PlanarFindings findings;
  const Domain domain = planar_domain(graph, "graph", Crossings::insert, &findings);
  EXPECT_EQ(findings.left_out.size(), 3U);
  const FrozenMesh frozen = meshed(domain).freeze();
  double inner = 0.0;
  for (std::size_t t = 0; t < frozen.triangles.size(); ++t) {
    const auto [a, b, c] = frozen.triangles[t];
    if (frozen.region_names.at(frozen.region[t]) == "inner")
      inner += 0.5 * cross(frozen.points[b] - frozen.points[a], frozen.points[c] - frozen.points[a]);
  }
  EXPECT_NEAR(inner, 4.0 - 0.25, 1e-12);
  EXPECT_EQ(frozen.region_names.size(), 2U);
}

// Random segments in a box: whatever crosses and overlaps, the result is a valid domain of the box's area,
// and what it is made of does not cross any more.
TEST(Planar, RandomCrossingSegmentsGiveAValidDomain) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto coordinate = [&](int grid) {
      return grid == 0 ? static_cast<double>(random() >> 11) * 0x1p-53 * 3.8 - 1.9
                       : static_cast<double>(random() % static_cast<unsigned>(grid)) * 3.0 / grid - 1.5;
    };
    PlanarGraph graph = polygons({square(0, 0, 2)});
    const int grid = seed % 2 == 0 ? 0 : 7;  // every other one full of exact coincidences
    for (int i = 0; i < 40; ++i)
      add_segment(graph, {coordinate(grid), coordinate(grid)}, {coordinate(grid), coordinate(grid)});
    const Domain domain = planar_domain(graph, "graph");
    EXPECT_NO_THROW(validate(domain));
    EXPECT_NEAR(area(domain), 16.0, 1e-9);
  }
}

// Nearly parallel lines, whose crossings round by much along them.
TEST(Planar, NearlyParallelCrossingsEnd) {
  PlanarGraph graph = polygons({square(0, 0, 2)});
  for (int i = 0; i < 30; ++i) add_segment(graph, {-1, i * 1e-15}, {1, (30 - i) * 1e-15});
  const Domain domain = planar_domain(graph, "graph");
  EXPECT_NO_THROW(validate(domain));
  EXPECT_NEAR(area(domain), 16.0, 1e-9);
}

}  // namespace
}  // namespace remodel
