#include <gtest/gtest.h>

#include "remodel/frozen_mesh.h"
#include "remodel/predicates.h"

namespace remodel {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A square beside a triangle, and a quadrilateral with a reflex corner above them.
FrozenMesh three_cells() {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 3}};
  mesh.triangles = {{1, 4, 2}};
  mesh.quads = {{0, 1, 2, 3}, {3, 2, 4, 5}};
  mesh.region_names = {"a", "b", "c"};
  mesh.region = {0, 1, 2};
  mesh.birth = {7};
  return mesh;
}

TEST(SplitQuads, HaveTwoCounterClockwiseTrianglesEachBehindTheOthers) {
  const FrozenMesh split = with_split_quads(three_cells());
  EXPECT_TRUE(split.quads.empty());
  EXPECT_EQ(split.triangles, (Triangles{{1, 4, 2}, {0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {2, 5, 3}}));
  for (const auto& [a, b, c] : split.triangles)
    EXPECT_GT(orient2d(split.points[a], split.points[b], split.points[c]), 0);
  EXPECT_EQ(split.region, (std::vector<std::uint32_t>{0, 1, 1, 2, 2}));
  EXPECT_TRUE(split.birth.empty());
}

TEST(SplitQuads, AMeshOfTrianglesStaysAsItIs) {
  FrozenMesh mesh = three_cells();
  mesh.quads.clear();
  mesh.region = {0};
  EXPECT_EQ(with_split_quads(mesh).triangles, mesh.triangles);
  EXPECT_EQ(with_split_quads(mesh).birth, mesh.birth);
}

TEST(Cells, AreTrianglesThenQuadrilaterals) {
  const FrozenMesh mesh = three_cells();
  ASSERT_EQ(mesh.cell_count(), 3U);
  EXPECT_EQ(mesh.cell(0).size(), 3U);
  EXPECT_EQ(mesh.cell(2)[3], 5U);
}

FrozenMesh with_names(FrozenMesh mesh) {
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    mesh.vertex_ids.push_back(v + 1);
    mesh.vertex_keys.push_back(v + 1);
    mesh.curve.push_back(-1);
    mesh.parameter.push_back(0);
  }
  mesh.triangle_ids = {3};
  return mesh;
}

TEST(Cells, FatesOfQuadrilateralsAreThoseOfTheirVertices) {
  const FrozenMesh before = with_names(three_cells());
  FrozenMesh after = before;
  after.points[5] = {1, 4};
  after.quads[0] = {2, 3, 0, 1};  // the same, from another corner on
  EXPECT_EQ(fates(before, after), (std::vector<Fate>{Fate::kept, Fate::kept, Fate::moved}));
  EXPECT_EQ(in_common(before, after, before).connected, 3U);
  EXPECT_EQ(in_common(before, after, before).preserved, 2U);
  after.quads[1] = {3, 2, 1, 5};
  EXPECT_EQ(fates(before, after)[2], Fate::made);
  EXPECT_EQ(in_common(before, after, before).connected, 2U);
}

}  // namespace
}  // namespace remodel
