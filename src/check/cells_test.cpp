// Meshes with quadrilaterals and with layers: good ones, and the same broken in every way that there is a
// rule for.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "remodel/check.h"

namespace remodel {
namespace {

using Names = std::set<std::string>;

Names broken(const FrozenMesh& mesh, const CheckOptions& options = {}) {
  const CheckResult result = check(mesh, options);
  Names names;
  for (const Violation& violation : result.violations) names.insert(violation.rule);
  EXPECT_EQ(result.valid, names.empty());
  return names;
}

// A wall from 0 to 4, on it two flat quadrilaterals and a third that three triangles take the place of,
// because the outer mesh has a point in the middle of its top; above them triangles.
FrozenMesh layer() {
  FrozenMesh mesh;
  mesh.points = {{0, 0},    {2, 0},    {4, 0},    {6, 0}, {0, 0.01}, {2, 0.01},
                 {4, 0.01}, {6, 0.01}, {5, 0.01}, {1, 2}, {3, 2},    {5, 2}};
  mesh.triangles = {{2, 3, 8},  {3, 7, 8},  {2, 8, 6},   {4, 5, 9}, {5, 10, 9},
                    {5, 6, 10}, {6, 8, 11}, {6, 11, 10}, {8, 7, 11}};
  mesh.layer_triangles = 3;
  mesh.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}};
  mesh.boundaries = {{"wall", {{0, 1}, {1, 2}, {2, 3}}},
                     {"rest", {{3, 7}, {7, 11}, {11, 10}, {10, 9}, {9, 4}, {4, 0}}}};
  return mesh;
}

TEST(CheckCells, ALayerIsValidHoweverFlat) {
  const FrozenMesh mesh = layer();
  const CheckResult result = check(mesh, {.min_angle_deg = 25});
  EXPECT_TRUE(result.valid) << (result.valid ? "" : result.violations[0].detail);
  EXPECT_TRUE(result.delaunay);
  EXPECT_EQ(result.triangles, 9U);
  EXPECT_EQ(result.quadrilaterals, 2U);
  EXPECT_EQ(result.vertices, 12U);
  EXPECT_DOUBLE_EQ(result.area, 0.06 + 1.99 * 5);
  EXPECT_GT(result.min_angle_deg, 25);
  EXPECT_DOUBLE_EQ(result.least_corner_deg, 90);
  EXPECT_DOUBLE_EQ(result.largest_corner_deg, 90);
}

// The top of a layer and an opening meet at 40 degrees: no refinement beyond the layer can do better.
TEST(CheckCells, TopsAreSidesOfSmallAngles) {
  const double x = std::cos(2.0 * std::numbers::pi / 9.0), y = std::sin(2.0 * std::numbers::pi / 9.0);
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}, {x, 0.1 + y}};
  mesh.triangles = {{3, 2, 4}};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.boundaries = {{"wall", {{0, 1}}}, {"outlet", {{1, 2}, {2, 4}}}, {"inlet", {{4, 3}, {3, 0}}}};
  EXPECT_EQ(broken(mesh, {.min_angle_deg = 45}), Names{"angle"});  // another program's quadrilateral
  mesh.vertex_ids = {0, 1, 2, 3, 4};
  mesh.vertex_keys = {0, 1, 2, 3, 4};
  const CheckResult result = check(mesh, {.min_angle_deg = 45});
  EXPECT_TRUE(result.valid) << (result.valid ? "" : result.violations[0].detail);
  EXPECT_EQ(result.exempt_triangles, 1U);
}

TEST(CheckCells, ItsTrianglesAreHeldToTheBoundsIfTheyAreOfNoLayer) {
  FrozenMesh mesh = layer();
  mesh.layer_triangles = 0;
  EXPECT_EQ(broken(mesh, {.min_angle_deg = 25}), Names{"angle"});
  mesh.layer_triangles = 10;
  EXPECT_EQ(broken(mesh), Names{"index"});
}

TEST(CheckCells, QuadrilateralsAreStrictlyConvexToTheLastBit) {
  FrozenMesh mesh;
  const auto with = [&](Point p) {
    mesh.points = {{0, 0}, {1, 0}, {1, 1}, p};
    return mesh;
  };
  mesh.quads = {{0, 1, 2, 3}};
  mesh.boundaries = {{"wall", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}};
  const double above = std::nextafter(0.3, 1.0), below = std::nextafter(0.3, 0.0);
  EXPECT_EQ(broken(with({0.3, above})), Names{});
  EXPECT_EQ(broken(with({0.3, 0.3})), Names{"convex"});
  EXPECT_EQ(broken(with({0.3, below})), Names{"convex"});
  EXPECT_EQ(check(with({0.3, 0.3})).violations[0].detail, "quadrilateral 0 is not strictly convex");
  mesh.quads = {{0, 3, 2, 1}};
  EXPECT_TRUE(broken(with({0, 1})).contains("convex"));
  EXPECT_EQ(check(with({0, 1})).violations[0].detail, "quadrilateral 0 is clockwise");
  mesh.quads = {{0, 2, 1, 3}};  // crosses itself
  EXPECT_TRUE(broken(with({0, 1})).contains("convex"));
}

TEST(CheckCells, EdgesAreInTwoCellsAtMost) {
  FrozenMesh mesh = layer();
  mesh.quads.push_back({1, 2, 6, 5});
  EXPECT_EQ(check(mesh).violations[0].rule, "adjacency");
  mesh = layer();
  mesh.quads.pop_back();  // a hole that nobody names
  EXPECT_TRUE(broken(mesh).contains("boundary"));
  mesh = layer();
  mesh.triangles.erase(mesh.triangles.begin() + 2);  // the split cell does not conform
  mesh.layer_triangles = 2;
  EXPECT_TRUE(broken(mesh).contains("boundary"));
}

TEST(CheckCells, IndicesAndArraysAreThoseOfCells) {
  FrozenMesh mesh = layer();
  mesh.quads[1][2] = 12;
  EXPECT_EQ(broken(mesh), Names{"index"});
  EXPECT_EQ(check(mesh).violations[0].detail, "quadrilateral 10 has a point index of 12 or more");
  mesh.quads[1][2] = 1;
  EXPECT_EQ(check(mesh).violations[0].detail, "quadrilateral 10 has the same point twice");
  mesh = layer();
  mesh.region_names = {"a", "b"};
  mesh.region.assign(mesh.triangles.size(), 0);
  EXPECT_EQ(broken(mesh), Names{"index"});
  mesh.region.resize(mesh.cell_count(), 1);
  EXPECT_EQ(broken(mesh), Names{});
  EXPECT_EQ(check(mesh).regions.at("b"), 2U);
}

TEST(CheckCells, EdgesOfLayersAreNoDelaunayEdges) {
  // The circle of the triangle above holds a point of the wall: beside a quadrilateral that says nothing.
  FrozenMesh mesh = layer();
  mesh.points[0] = {0.5, 0};
  EXPECT_EQ(broken(mesh), Names{});
  EXPECT_TRUE(check(mesh).delaunay);
  // Between two triangles it does.
  mesh = with_split_quads(mesh);
  EXPECT_EQ(broken(mesh), Names{"delaunay"});
}

TEST(CheckCells, EveryChangeOfAQuadrilateralIsFound) {
  const FrozenMesh good = layer();
  for (std::size_t q = 0; q < good.quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::uint32_t v = 0; v < good.points.size(); ++v) {
        if (v == good.quads[q][k]) continue;
        FrozenMesh mesh = good;
        mesh.quads[q][k] = v;
        EXPECT_FALSE(check(mesh).valid) << q << ' ' << k << ' ' << v;
      }
}

TEST(CheckCells, AMeshOfQuadrilateralsAloneHasNoSmallestAngleOfTriangles) {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.boundaries = {{"wall", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}};
  const CheckResult result = check(mesh, {.min_angle_deg = 30});
  EXPECT_TRUE(result.valid);
  EXPECT_TRUE(std::isnan(result.min_angle_deg));
  EXPECT_EQ(result.area, 2.0);
}

}  // namespace
}  // namespace remodel
