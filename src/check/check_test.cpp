// Good meshes made by hand, and the same meshes broken in every way that the checker has a rule for.

#include "remodel/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "check/exact_points.h"
#include "remodel/predicates.h"
#include "support.h"

namespace remodel {
namespace {

using Names = std::set<std::string>;
using Edges = std::vector<std::array<std::uint32_t, 2>>;

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double up(double v) {
  return std::nextafter(v, infinity);
}
double down(double v) {
  return std::nextafter(v, -infinity);
}

Names broken_rules(const FrozenMesh& mesh, const CheckOptions& options = {}) {
  const CheckResult result = check(mesh, options);
  Names names;
  for (const Violation& violation : result.violations) {
    names.insert(violation.rule);
    EXPECT_FALSE(violation.detail.empty());
  }
  EXPECT_EQ(result.valid, names.empty());
  return names;
}

// The closed polygon of the points, as boundary edges in this order.
Edges polygon(const std::vector<std::uint32_t>& points) {
  Edges edges;
  for (std::size_t i = 0; i < points.size(); ++i)
    edges.push_back({points[i], points[(i + 1) % points.size()]});
  return edges;
}

FrozenMesh make_mesh(std::vector<Point> points, std::vector<std::array<std::uint32_t, 3>> triangles,
                     std::vector<FrozenBoundary> boundaries) {
  FrozenMesh mesh;
  mesh.points = std::move(points);
  mesh.triangles = std::move(triangles);
  mesh.boundaries = std::move(boundaries);
  return mesh;
}

FrozenMesh square() {
  return make_mesh({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}},
                   {{"wall", polygon({0, 1, 2, 3})}});
}

// Outer points 0 to 3, points of the hole 4 to 7.
FrozenMesh square_with_hole() {
  return make_mesh({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}},
                   {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}},
                   {{"outer", polygon({0, 1, 2, 3})}, {"inner", polygon({4, 7, 6, 5})}});
}

// n x n cells of unit size; every cell and every point's neighbourhood is a tie.
FrozenMesh grid(std::uint32_t n) {
  FrozenMesh mesh;
  const auto at = [n](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  std::vector<std::uint32_t> rim;
  for (std::uint32_t i = 0; i < n; ++i) rim.push_back(at(i, 0));
  for (std::uint32_t j = 0; j < n; ++j) rim.push_back(at(n, j));
  for (std::uint32_t i = n; i > 0; --i) rim.push_back(at(i, n));
  for (std::uint32_t j = n; j > 0; --j) rim.push_back(at(0, j));
  mesh.boundaries = {{"rim", polygon(rim)}};
  mesh.length_scale.assign(mesh.points.size(), 1.0);
  return mesh;
}

// ---- Good meshes ----

TEST(Check, AcceptsAGoodMeshAndMeasuresIt) {
  const CheckResult result = check(square_with_hole());
  EXPECT_TRUE(result.valid);
  EXPECT_TRUE(result.delaunay);
  EXPECT_EQ(result.triangles, 8U);
  EXPECT_EQ(result.vertices, 8U);
  EXPECT_EQ(result.area, 8.0);
  EXPECT_EQ(result.boundary, (std::map<std::string, std::size_t>{{"outer", 4}, {"inner", 4}}));
  EXPECT_NEAR(result.min_angle_deg, 180 / pi * std::atan(1.0 / 3), 1e-12);
  EXPECT_TRUE(std::isnan(result.max_gradation));
}

TEST(Check, AcceptsAGridOfExactTies) {
  const CheckResult result = check(grid(50), {.min_angle_deg = 45, .max_gradation = std::sqrt(0.5)});
  EXPECT_TRUE(result.valid);
  EXPECT_TRUE(result.delaunay);
  EXPECT_EQ(result.area, 2500.0);
  EXPECT_NEAR(result.min_angle_deg, 45, 1e-12);
  EXPECT_NEAR(result.max_gradation, 1, 1e-12);
}

TEST(Check, AcceptsExactCopiesOfAGoodMesh) {
  for (const double scale : {0x1p-300, 0x1p-40, 0x1p60, 0x1p300}) {
    FrozenMesh mesh = grid(6);
    for (Point& p : mesh.points) p = scale * (p + Point{1000, -7});
    mesh.length_scale.clear();
    EXPECT_EQ(broken_rules(mesh), Names{}) << scale;
  }
}

TEST(Check, AcceptsSeveralNamesOnALoopAndSeveralLoopsUnderAName) {
  FrozenMesh mesh = square_with_hole();
  mesh.boundaries = {
      {"sides", {{1, 2}, {3, 0}}}, {"ends", {{0, 1}, {2, 3}}}, {"hole", polygon({7, 6, 5, 4})}};
  EXPECT_EQ(broken_rules(mesh), Names{});
  mesh = square_with_hole();
  Edges& outer = mesh.boundaries[0].edges;
  outer.insert(outer.end(), mesh.boundaries[1].edges.begin(), mesh.boundaries[1].edges.end());
  mesh.boundaries.pop_back();
  EXPECT_EQ(broken_rules(mesh), Names{});
}

TEST(Check, AcceptsTwoComponents) {
  FrozenMesh mesh = square();
  for (const Point& p : square().points) mesh.points.push_back(p + Point{5, 0});
  mesh.triangles.push_back({4, 5, 6});
  mesh.triangles.push_back({4, 6, 7});
  mesh.boundaries.push_back({"other", polygon({4, 5, 6, 7})});
  EXPECT_EQ(broken_rules(mesh), Names{});
}

// ---- Index and finite ----

TEST(Check, NamesIndicesOutOfRange) {
  FrozenMesh mesh = square();
  mesh.triangles[1][2] = 4;
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
  mesh = square();
  mesh.boundaries[0].edges[2][0] = 0xffffffff;
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
}

TEST(Check, NamesATriangleOrAnEdgeWithAPointTwice) {
  FrozenMesh mesh = square();
  mesh.triangles[1] = {0, 2, 2};
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
  mesh = square();
  mesh.boundaries[0].edges[2] = {3, 3};
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
}

TEST(Check, NamesArraysOfTheWrongSize) {
  FrozenMesh mesh = square();
  mesh.length_scale = {1, 1, 1};
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
  mesh = square();
  mesh.birth = {0, 0, 0};
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
}

TEST(Check, NamesAMeshWithoutTriangles) {
  EXPECT_EQ(broken_rules({}), Names{"index"});
  FrozenMesh mesh = square();
  mesh.triangles.clear();
  EXPECT_EQ(broken_rules(mesh), Names{"index"});
}

TEST(Check, NamesNumbersThatAreNotFinite) {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    FrozenMesh mesh = square();
    mesh.points[2].y = bad;
    EXPECT_EQ(broken_rules(mesh), Names{"finite"});
    mesh = square();
    mesh.length_scale = {1, bad, 1, 1};
    EXPECT_EQ(broken_rules(mesh), Names{"finite"});
    mesh = square();
    mesh.parameter = {0, 0, bad, 0};
    EXPECT_EQ(broken_rules(mesh), Names{"finite"});
  }
}

// ---- Points ----

TEST(Check, NamesAPointWithoutTriangle) {
  FrozenMesh mesh = square();
  mesh.points.push_back({0.5, 0.25});
  const CheckResult result = check(mesh);
  ASSERT_EQ(result.violations.size(), 1U);
  EXPECT_EQ(result.violations[0].rule, "orphan-vertex");
  EXPECT_EQ(result.violations[0].ids, std::vector<std::uint32_t>{4});
}

TEST(Check, CountsPointsWithoutTriangleWhereTheyAreAllowed) {
  FrozenMesh mesh = square();
  mesh.points.insert(mesh.points.end(), {{0.5, 0.25}, mesh.points[1], {9, 9}});
  CheckOptions options;
  options.unused_points = true;
  const CheckResult result = check(mesh, options);
  EXPECT_TRUE(result.valid);
  EXPECT_EQ(result.unused_points, 3U);
  EXPECT_EQ(result.vertices, 4U);
}

// Two squares that touch at (1, 1), with a point each.
TEST(Check, NamesPointsThatCoincide) {
  FrozenMesh mesh = square();
  for (const Point& p : square().points) mesh.points.push_back(p + Point{1, 1});
  mesh.triangles.push_back({4, 5, 6});
  mesh.triangles.push_back({4, 6, 7});
  mesh.boundaries.push_back({"other", polygon({4, 5, 6, 7})});
  EXPECT_EQ(broken_rules(mesh), (Names{"duplicate", "overlap"}));
}

// ---- Orientation ----

// A square whose diagonal 0-2 carries point 4, with a sliver between the two.
FrozenMesh square_with_sliver(Point on_diagonal) {
  FrozenMesh mesh = square();
  mesh.points.push_back(on_diagonal);
  mesh.triangles = {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return mesh;
}

TEST(Check, DecidesOrientationToTheLastBit) {
  const CheckOptions not_delaunay{.delaunay = false};
  EXPECT_EQ(broken_rules(square_with_sliver({0.3, 0.3}), not_delaunay), Names{"orientation"});
  EXPECT_EQ(broken_rules(square_with_sliver({0.3, up(0.3)}), not_delaunay), Names{});
  EXPECT_EQ(broken_rules(square_with_sliver({0.3, down(0.3)}), not_delaunay), (Names{"orientation", "area"}));
}

TEST(Check, DecidesOrientationWhereMagnitudesLieFarApart) {
  const auto with_point_at_height = [](double y) {
    FrozenMesh mesh = square();
    mesh.points.push_back({0.3, y});
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    return broken_rules(mesh);
  };
  EXPECT_EQ(with_point_at_height(1e-300), Names{});
  EXPECT_EQ(with_point_at_height(5e-324), Names{});
  EXPECT_EQ(with_point_at_height(0), Names{"orientation"});
  EXPECT_EQ(with_point_at_height(-1e-300), (Names{"orientation", "area"}));
}

TEST(Check, NamesAMirroredMesh) {
  FrozenMesh mesh = square_with_hole();
  for (Point& p : mesh.points) p.x = -p.x;
  EXPECT_EQ(broken_rules(mesh), (Names{"orientation", "area"}));
}

// ---- Adjacency ----

TEST(Check, NamesATriangleTurnedOver) {
  FrozenMesh mesh = grid(4);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_EQ(broken_rules(mesh), (Names{"orientation", "adjacency"}));
}

TEST(Check, NamesAnEdgeOfThreeTriangles) {
  FrozenMesh mesh = square();
  mesh.points.push_back({0.2, 0.9});
  mesh.triangles.push_back({0, 2, 4});
  EXPECT_EQ(broken_rules(mesh), Names{"adjacency"});
}

TEST(Check, NamesATriangleThatIsThereTwice) {
  FrozenMesh mesh = grid(3);
  mesh.triangles.push_back(mesh.triangles[5]);
  EXPECT_EQ(broken_rules(mesh), Names{"adjacency"});
}

// ---- Boundary ----

TEST(Check, NamesAMeshWithoutBoundaryNames) {
  FrozenMesh mesh = square();
  mesh.boundaries.clear();
  const CheckResult result = check(mesh);
  ASSERT_EQ(result.violations.size(), 1U);
  EXPECT_EQ(result.violations[0].rule, "boundary");
  EXPECT_EQ(result.violations[0].detail, "none of the 4 boundary edges has a name");
}

TEST(Check, NamesABoundaryEdgeWithoutName) {
  FrozenMesh mesh = square_with_hole();
  mesh.boundaries[1].edges.pop_back();
  EXPECT_EQ(broken_rules(mesh), (Names{"boundary", "area"}));
}

TEST(Check, NamesAMissingTriangle) {
  FrozenMesh mesh = grid(5);
  mesh.triangles.erase(mesh.triangles.begin() + 24);
  EXPECT_EQ(broken_rules(mesh), (Names{"boundary", "area"}));
}

TEST(Check, NamesABoundaryEdgeWithTheDomainOnItsRight) {
  FrozenMesh mesh = square();
  std::swap(mesh.boundaries[0].edges[1][0], mesh.boundaries[0].edges[1][1]);
  EXPECT_EQ(broken_rules(mesh), (Names{"boundary", "area"}));
}

TEST(Check, NamesABoundaryEdgeThatIsNoEdgeOfTheMesh) {
  FrozenMesh mesh = square();
  mesh.boundaries.push_back({"phantom", {{1, 3}}});
  EXPECT_EQ(broken_rules(mesh), (Names{"boundary", "area"}));
}

TEST(Check, NamesABoundaryEdgeOfTwoNames) {
  FrozenMesh mesh = square();
  mesh.boundaries.push_back({"again", {{1, 2}}});
  EXPECT_EQ(broken_rules(mesh), (Names{"boundary", "area"}));
}

TEST(Check, NamesBoundaryEdgesOutOfOrder) {
  FrozenMesh mesh = grid(3);
  std::swap(mesh.boundaries[0].edges[3], mesh.boundaries[0].edges[7]);
  EXPECT_EQ(broken_rules(mesh), Names{"boundary"});
}

// Parameters of a design may run against the direction that has the domain on the left.
TEST(Check, AcceptsBoundaryEdgesInTheOrderOfTheLoopBackwards) {
  FrozenMesh mesh = grid(3);
  Edges& edges = mesh.boundaries[0].edges;
  std::reverse(edges.begin(), edges.end());
  std::rotate(edges.begin(), edges.begin() + 5, edges.end());
  EXPECT_EQ(broken_rules(mesh), Names{});
}

TEST(Check, NamesADomainThatBoundaryNamesDoNotDescribe) {
  FrozenMesh mesh = square_with_hole();
  mesh.boundaries[1].edges.clear();
  EXPECT_TRUE(broken_rules(mesh).contains("area"));
}

// ---- Manifold and Euler ----

// Which loops may touch a design says; a mesh without one may be of any domain.
TEST(Check, CountsLoopsThatTouchAtAPoint) {
  const FrozenMesh mesh = make_mesh({{0, 0}, {1, 0}, {1, 1}, {-1, 0}, {-1, -1}}, {{0, 1, 2}, {0, 3, 4}},
                                    {{"right", polygon({0, 1, 2})}, {"left", polygon({0, 3, 4})}});
  const CheckResult result = check(mesh);
  EXPECT_TRUE(result.valid);
  EXPECT_EQ(result.touching_points, 1U);
}

TEST(Check, NamesTrianglesThatOverlapWhereLoopsTouch) {
  // The second one inside the first, and across one of its sides; the last beside it.
  for (const auto& [third, fourth, valid] :
       {std::tuple(Point{0.6, 0.2}, Point{0.6, 0.4}, false),
        std::tuple(Point{0.6, 0.2}, Point{0.6, 1.4}, false), std::tuple(Point{2, 0.5}, Point{2, 4}, false),
        std::tuple(Point{0.6, 1.2}, Point{-0.6, 1.4}, true)}) {
    const FrozenMesh mesh = make_mesh({{0, 0}, {1, 0}, {1, 1}, third, fourth}, {{0, 1, 2}, {0, 3, 4}},
                                      {{"one", polygon({0, 1, 2})}, {"other", polygon({0, 3, 4})}});
    EXPECT_EQ(check(mesh).valid, valid) << third.x << " " << fourth.y;
    EXPECT_EQ(broken_rules(mesh), valid ? Names{} : Names{"overlap"});
  }
}

// A closed fan of three triangles and an open one of two share their apex: turning from the closed one both
// ways must not count it twice.
TEST(Check, NamesAClosedAndAnOpenFanAtAPoint) {
  const FrozenMesh mesh = make_mesh({{0, 0}, {2, 0}, {-1, 2}, {-1, -2}, {8, -1}, {8, 0}, {8, 1}},
                                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}},
                                    {{"inner", polygon({1, 2, 3})}, {"open", polygon({0, 4, 5, 6})}});
  EXPECT_EQ(broken_rules(mesh), Names{"manifold"});
}

// A strip with two handles whose feet alternate: a torus with a hole, flat everywhere but over itself where
// the handles cross. Feet at x = 0..1, 2..3, 4..5, 6..7; handles join the first with the third and the second
// with the fourth.
FrozenMesh strip_with_two_handles() {
  FrozenMesh mesh;
  for (int x = 0; x < 8; ++x) mesh.points.push_back({static_cast<double>(x), -1});  // 0 to 7
  for (int x = 0; x < 8; ++x) mesh.points.push_back({static_cast<double>(x), 0});   // 8 to 15
  for (std::uint32_t x = 0; x < 7; ++x) {
    mesh.triangles.push_back({x, x + 1, x + 9});
    mesh.triangles.push_back({x, x + 9, x + 8});
  }
  const auto handle = [&](std::uint32_t left, std::uint32_t right, double height) {
    const auto top = static_cast<std::uint32_t>(mesh.points.size());
    const double outer_left = mesh.points[left].x, inner_left = outer_left + 1;
    const double inner_right = mesh.points[right].x, outer_right = inner_right + 1;
    mesh.points.insert(mesh.points.end(), {{outer_left, height + 1}, {inner_left, height}});
    mesh.points.insert(mesh.points.end(), {{inner_right, height}, {outer_right, height + 1}});
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    };
    quad(left, left + 1, top + 1, top);
    quad(top + 1, top + 2, top + 3, top);
    quad(right, right + 1, top + 3, top + 2);
  };
  handle(8, 12, 1);
  handle(10, 14, 4);
  return mesh;
}

TEST(Check, NamesASurfaceThatIsNotPlanar) {
  const Names rules = broken_rules(strip_with_two_handles(), {.delaunay = false});
  EXPECT_EQ(rules, (Names{"boundary", "euler", "overlap"}));
}

// ---- Overlap ----

// A ring of eight quadrilaterals that goes twice around: each part of it is a good mesh.
TEST(Check, NamesARingThatCoversItselfTwice) {
  FrozenMesh mesh;
  const std::uint32_t n = 16;
  std::vector<std::uint32_t> outer, inner;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 4 * pi * i / n;
    const double shift = 0.125 * i / n;  // the ring rises into a spiral and falls back where it closes
    mesh.points.push_back({(1 + shift) * std::cos(angle), (1 + shift) * std::sin(angle)});
    mesh.points.push_back({(2 + shift) * std::cos(angle), (2 + shift) * std::sin(angle)});
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = (2 * i + 3) % (2 * n), d = (2 * i + 2) % (2 * n);
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
    outer.push_back(b);
    inner.insert(inner.begin(), a);
  }
  mesh.boundaries = {{"outer", polygon(outer)}, {"inner", polygon(inner)}};
  EXPECT_EQ(broken_rules(mesh, {.delaunay = false}), Names{"overlap"});
}

TEST(Check, NamesAMeshThatLiesOverAnother) {
  FrozenMesh mesh = square();
  for (const Point& p : square().points) mesh.points.push_back(0.25 * p + Point{0.5, 0.125});
  mesh.triangles.push_back({4, 5, 6});
  mesh.triangles.push_back({4, 6, 7});
  mesh.boundaries.push_back({"other", polygon({4, 5, 6, 7})});
  EXPECT_EQ(broken_rules(mesh), Names{"overlap"});
}

TEST(Check, AcceptsAMeshInTheHoleOfAnother) {
  FrozenMesh mesh = square_with_hole();
  for (const Point& p : square().points) mesh.points.push_back(0.5 * p + Point{1.25, 1.25});
  mesh.triangles.push_back({8, 9, 10});
  mesh.triangles.push_back({8, 10, 11});
  mesh.boundaries.push_back({"island", polygon({8, 9, 10, 11})});
  EXPECT_EQ(broken_rules(mesh), Names{});
}

TEST(Check, DecidesToTheLastBitWhetherBoundariesTouch) {
  const auto with_neighbour_at = [](double x) {
    FrozenMesh mesh = square();
    mesh.points.insert(mesh.points.end(), {{x, 0.5}, {2, 0}, {2, 1}});
    mesh.triangles.push_back({4, 5, 6});
    mesh.boundaries.push_back({"neighbour", polygon({4, 5, 6})});
    return broken_rules(mesh);
  };
  EXPECT_EQ(with_neighbour_at(up(1)), Names{});
  EXPECT_EQ(with_neighbour_at(1), Names{"overlap"});
  EXPECT_EQ(with_neighbour_at(down(1)), Names{"overlap"});
}

// ---- Delaunay ----

TEST(Check, DecidesDelaunayToTheLastBit) {
  FrozenMesh mesh = square();
  mesh.points[1].x = up(1);  // away from the circle of 0, 2, 3
  EXPECT_EQ(broken_rules(mesh), Names{});
  mesh.points[1].x = down(1);
  const CheckResult result = check(mesh);
  ASSERT_EQ(result.violations.size(), 1U);
  EXPECT_EQ(result.violations[0].rule, "delaunay");
  EXPECT_EQ(result.violations[0].ids, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_FALSE(result.delaunay);
}

TEST(Check, ReportsDelaunayInTheResultOnlyIfToldSo) {
  FrozenMesh mesh = square();
  mesh.points[1].x = down(1);
  const CheckResult result = check(mesh, {.delaunay = false});
  EXPECT_TRUE(result.valid);
  EXPECT_FALSE(result.delaunay);
}

TEST(Check, ExemptsNamedInnerEdgesFromDelaunay) {
  FrozenMesh mesh = square();
  mesh.points[1].x = 0.9;
  EXPECT_EQ(broken_rules(mesh), Names{"delaunay"});
  mesh.boundaries.push_back({"wire", {{2, 0}}});
  EXPECT_EQ(broken_rules(mesh), Names{});
}

// ---- Angle and gradation ----

TEST(Check, ComparesAnglesWithTheBound) {
  EXPECT_EQ(broken_rules(square(), {.min_angle_deg = 45}), Names{});
  EXPECT_EQ(broken_rules(square(), {.min_angle_deg = 45.0001}), Names{"angle"});
  FrozenMesh mesh = square();
  mesh.points[3].x = -2;  // atan(1/2) is less than 30 degrees
  const CheckResult result = check(mesh, {.min_angle_deg = 30});
  ASSERT_EQ(result.violations.size(), 1U);
  EXPECT_EQ(result.violations[0].rule, "angle");
  EXPECT_EQ(result.violations[0].ids, std::vector<std::uint32_t>{1});
}

TEST(Check, ComparesTheGradationWithTheBound) {
  FrozenMesh mesh = square();
  mesh.length_scale = {1, 1, 1, 1};
  EXPECT_EQ(broken_rules(mesh, {.max_gradation = std::sqrt(0.5)}), Names{});
  mesh.length_scale[3] = 0.7;
  const CheckResult result = check(mesh, {.max_gradation = std::sqrt(0.5)});
  ASSERT_EQ(result.violations.size(), 1U);
  EXPECT_EQ(result.violations[0].rule, "gradation");
  EXPECT_EQ(result.violations[0].ids, std::vector<std::uint32_t>{1});
  EXPECT_NEAR(result.max_gradation, 1 / 0.9, 1e-12);
  EXPECT_NEAR(check(mesh).max_gradation, 1 / 0.9, 1e-12);
  EXPECT_TRUE(check(mesh).valid);
}

TEST(Check, NamesAGradationThatCannotBeTested) {
  EXPECT_EQ(broken_rules(square(), {.max_gradation = 1}), Names{"gradation"});
  FrozenMesh mesh = square();
  mesh.length_scale = {0, 0, 0, 0};
  EXPECT_EQ(broken_rules(mesh, {.max_gradation = 1}), Names{"gradation"});
}

// ---- Limits and malformed input ----

TEST(Check, ListsNoMoreViolationsThanAskedFor) {
  FrozenMesh mesh = grid(10);
  for (Point& p : mesh.points) p.x = -p.x;
  const CheckResult result = check(mesh, {.max_violations = 7});
  EXPECT_FALSE(result.valid);
  EXPECT_EQ(result.violations.size(), 7U);
  EXPECT_FALSE(check(mesh, {.max_violations = 0}).valid);
}

// Any change of one number of a valid grid, which has no freedom in its connectivity, is found.
TEST(Check, FindsEveryChangeOfATriangleOrABoundaryEdge) {
  const unsigned long long seed = test::seed(3);
  std::mt19937_64 random{seed};
  const FrozenMesh good = grid(5);
  for (int i = 0; i < 3000; ++i) {
    FrozenMesh mesh = good;
    const auto other = static_cast<std::uint32_t>(random() % (good.points.size() + 2));
    std::uint32_t& changed =
        random() % 2 == 0
            ? mesh.triangles[random() % mesh.triangles.size()][random() % 3]
            : mesh.boundaries[0].edges[random() % mesh.boundaries[0].edges.size()][random() % 2];
    if (changed == other) continue;
    changed = other;
    ASSERT_FALSE(check(mesh).valid) << "seed " << seed << " case " << i;
  }
}

TEST(Check, SurvivesMeshesOfRandomNumbers) {
  const unsigned long long seed = test::seed(5);
  std::mt19937_64 random{seed};
  const std::array<double, 9> values{0, -0.0, 1, 0.5, 1e-300, -1e300, 5e-324, up(1), -1};
  const auto any = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int i = 0; i < 3000; ++i) {
    FrozenMesh mesh;
    const std::size_t n = 3 + random() % 6;
    for (std::size_t v = 0; v < n; ++v) mesh.points.push_back({values[any(9)], values[any(9)]});
    for (std::size_t t = 0; t <= random() % 8; ++t) mesh.triangles.push_back({any(n), any(n), any(n)});
    mesh.boundaries.push_back({"any", {}});
    for (std::size_t e = 0; e <= random() % 8; ++e) mesh.boundaries[0].edges.push_back({any(n), any(n)});
    mesh.length_scale.assign(n, values[any(9)]);
    const CheckResult result = check(mesh, {.min_angle_deg = 20, .max_gradation = 1});
    ASSERT_EQ(result.valid, result.violations.empty()) << "seed " << seed << " case " << i;
  }
}

// ---- The checker's arithmetic against the kernel's ----

TEST(Check, AgreesWithTheKernelsPredicates) {
  const unsigned long long seed = test::seed(9);
  std::mt19937_64 random{seed};
  for (int i = 0; i < 20000; ++i) {
    std::vector<Point> p;
    for (int k = 0; k < 4; ++k) {
      const double angle = static_cast<double>(random() % 24) * pi / 12;
      p.push_back({std::cos(angle), 0.5 + std::sin(angle)});
    }
    if (i % 10 == 0) p.push_back({1e-90, 0});  // the span of this point asks for integers without bound
    const auto exact = checker::exact_points(p);
    ASSERT_EQ(exact->orientation(0, 1, 2), orient2d(p[0], p[1], p[2])) << "seed " << seed << " case " << i;
    ASSERT_EQ(exact->in_circle(0, 1, 2, 3), incircle(p[0], p[1], p[2], p[3]))
        << "seed " << seed << " case " << i;
  }
}

// ---- Design ----

Curve line(std::string name, Point from, Point to, std::vector<double> parameters) {
  return {std::move(name), Line{from, to}, std::move(parameters)};
}

// The unit square, counter-clockwise, as four lines, each with a point at its beginning.
Domain square_design() {
  return {{{LoopRole::outer,
            {line("bottom", {0, 0}, {1, 0}, {0}), line("right", {1, 0}, {1, 1}, {0}),
             line("top", {1, 1}, {0, 1}, {0}), line("left", {0, 1}, {0, 0}, {0})}}}};
}

// Its mesh: corners and midpoints of the sides 0 to 7, the centre 8.
FrozenMesh square_of_design(const Domain& design) {
  FrozenMesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.curve.push_back(static_cast<std::int32_t>(i / 2));
    mesh.parameter.push_back(i % 2 == 0 ? 0.0 : 0.5);
    mesh.points.push_back(design.at({i / 2, mesh.parameter[i]}));
    mesh.triangles.push_back({i, (i + 1) % 8, 8});
    if (i % 2 == 0) mesh.boundaries.push_back({design.curve(i / 2).name, {}});
    mesh.boundaries.back().edges.push_back({i, (i + 1) % 8});
  }
  mesh.points.push_back({0.5, 0.5});
  mesh.curve.push_back(-1);
  mesh.parameter.push_back(0);
  return mesh;
}

class CheckDesign : public ::testing::Test {
 protected:
  Names broken() const { return broken_rules(mesh_, {.design = &design_}); }

  Domain design_ = square_design();
  FrozenMesh mesh_ = square_of_design(design_);
};

TEST_F(CheckDesign, AcceptsAMeshWithSteinerPointsOnItsCurves) {
  EXPECT_EQ(broken(), Names{});
}

TEST_F(CheckDesign, NamesAMeshThatDoesNotKnowItsCurves) {
  mesh_.curve.clear();
  EXPECT_EQ(broken(), Names{"design"});
}

TEST_F(CheckDesign, NamesAPointOneUlpOffItsCurve) {
  mesh_.points[1].y = -5e-324;
  EXPECT_EQ(broken(), Names{"design"});
  mesh_.points[1] = {up(0.5), 0};
  EXPECT_TRUE(broken().contains("design"));
}

TEST_F(CheckDesign, NamesAStationThatIsMissing) {
  design_.loops[0].curves[2].parameters = {0, 0.25};
  EXPECT_EQ(broken(), Names{"design"});
}

TEST_F(CheckDesign, NamesCurvesAndParametersThatTheDesignLacks) {
  mesh_.curve[2] = 4;
  EXPECT_EQ(broken(), Names{"design"});
  mesh_.curve[2] = -1;
  EXPECT_EQ(broken(), Names{"design"});
  mesh_.curve[2] = 1;
  mesh_.parameter[2] = 1.5;
  EXPECT_EQ(broken(), Names{"design"});
}

TEST_F(CheckDesign, NamesAnInnerPointThatClaimsACurve) {
  mesh_.curve[8] = 0;
  EXPECT_EQ(broken(), Names{"design"});
}

TEST_F(CheckDesign, NamesAnEdgeUnderTheNameOfAnotherCurve) {
  std::swap(mesh_.boundaries[0].name, mesh_.boundaries[1].name);
  EXPECT_EQ(broken(), Names{"design"});
}

TEST_F(CheckDesign, NamesAMeshOnTheWrongSideOfALoop) {
  design_.loops[0].role = LoopRole::hole;
  EXPECT_EQ(broken(), Names{"design"});
}

TEST_F(CheckDesign, AcceptsALoopOfEitherOrientation) {
  design_ = {{{LoopRole::outer,
               {line("left", {0, 0}, {0, 1}, {0}), line("top", {0, 1}, {1, 1}, {0}),
                line("right", {1, 1}, {1, 0}, {0}), line("bottom", {1, 0}, {0, 0}, {0})}}}};
  mesh_.curve = {0, 3, 3, 2, 2, 1, 1, 0, -1};
  EXPECT_EQ(broken(), Names{});
}

TEST_F(CheckDesign, AcceptsAHoleAndTellsItFromTheOuterLoop) {
  design_ = {{{LoopRole::outer,
               {line("outer", {0, 0}, {3, 0}, {0}), line("outer", {3, 0}, {3, 3}, {0}),
                line("outer", {3, 3}, {0, 3}, {0}), line("outer", {0, 3}, {0, 0}, {0})}},
              {LoopRole::hole,
               {line("inner", {1, 1}, {2, 1}, {0}), line("inner", {2, 1}, {2, 2}, {0}),
                line("inner", {2, 2}, {1, 2}, {0}), line("inner", {1, 2}, {1, 1}, {0})}}}};
  mesh_ = square_with_hole();
  mesh_.curve = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh_.parameter.assign(8, 0.0);
  EXPECT_EQ(broken(), Names{});
  std::swap(mesh_.boundaries[0].name, mesh_.boundaries[1].name);
  EXPECT_EQ(broken(), Names{"design"});
}

}  // namespace
}  // namespace remodel
