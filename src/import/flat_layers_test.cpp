// Meshes with layers on walls: refused by name, or dissolved where that is wished.

#include "import/flat_layers.h"

#include <gtest/gtest.h>

#include "import/test_foreign.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/import.h"

namespace remodel {
namespace {

// A channel: on its floor a row of cells of that height, above it triangles as high as wide.
FrozenMesh channel(std::uint32_t cells, double height) {
  FrozenMesh mesh;
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      mesh.points.push_back({static_cast<double>(i), j == 0 ? 0.0 : j == 1 ? height : 1.0 + height});
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (cells + 1) + i; };
  FrozenBoundary floor{"floor", {}}, rest{"rest", {}};
  for (std::uint32_t i = 0; i < cells; ++i) {
    mesh.quads.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)});
    mesh.triangles.push_back({at(i, 1), at(i + 1, 1), at(i + 1, 2)});
    mesh.triangles.push_back({at(i, 1), at(i + 1, 2), at(i, 2)});
    floor.edges.push_back({at(i, 0), at(i + 1, 0)});
    rest.edges.push_back({at(i + 1, 2), at(i, 2)});
  }
  for (const auto& [a, b] : {std::pair{0U, 1U}, {1U, 2U}}) {
    rest.edges.push_back({at(cells, a), at(cells, b)});
    rest.edges.push_back({at(0, b), at(0, a)});
  }
  mesh.boundaries = {floor, rest};
  return mesh;
}

std::string refusal(const FrozenMesh& mesh) {
  try {
    import_mesh(mesh, "m");
  } catch (const Error& error) {
    return error.what();
  }
  return "imported";
}

TEST(FlatLayers, QuadrilateralsAreRefusedWithWhatToDo) {
  const std::string message = refusal(channel(10, 0.5));
  EXPECT_NE(message.find("m: 10 quadrilaterals found, which a remodelling would dissolve"), message.npos)
      << message;
  EXPECT_NE(message.find("--dissolve-layers"), message.npos);
  EXPECT_EQ(message.find('\n'), message.npos);
}

TEST(FlatLayers, OfTrianglesAreRefusedWhereTheyStandOnAWall) {
  const std::string message = refusal(with_split_quads(channel(10, 0.04)));
  EXPECT_NE(message.find("triangles flatter than 20 to 1 on 10 of 10 edges of 'floor' found"), message.npos)
      << message;
  EXPECT_EQ(refusal(with_split_quads(channel(10, 0.06))), "imported");
  // A few flat triangles are no layer.
  EXPECT_EQ(refusal(with_split_quads(channel(7, 0.04))), "imported");
}

TEST(FlatLayers, AreDissolvedWhereThatIsWished) {
  for (const double height : {0.5, 0.04}) {
    const FrozenMesh mesh = channel(10, height);
    const ImportResult result = import_mesh(mesh, "m", {.layers = FlatLayers::dissolve});
    const FrozenMesh back = result.mesh.freeze();
    EXPECT_TRUE(back.quads.empty());
    EXPECT_EQ(back.triangles.size(), 40U);
    EXPECT_TRUE(check(back).valid);
    EXPECT_DOUBLE_EQ(check(back).area, check(mesh).area);
  }
}

TEST(FlatLayers, QuadrilateralsOfPointsThatAreNotThereAreNamed) {
  FrozenMesh mesh = channel(10, 0.5);
  mesh.quads[3][1] = 99;
  try {
    import_mesh(mesh, "m", {.layers = FlatLayers::dissolve});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "m: quadrilateral 3: point 99 found, an index below 33 expected");
  }
}

TEST(FlatLayers, OurOwnMeshesHaveNone) {
  EXPECT_EQ(refusal(test::foreign_airfoil()), "imported");
  EXPECT_EQ(refusal(test::foreign_holes()), "imported");
}

}  // namespace
}  // namespace remodel
