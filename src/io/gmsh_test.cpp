// Gmsh as an oracle: it reads what we write, and we read what it writes from that.

#include <gtest/gtest.h>

#include <cstdlib>

#include "io/test_meshes.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using test::Scratch;

bool runs(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

std::size_t edge_count(const FrozenMesh& mesh) {
  std::size_t count = 0;
  for (const auto& boundary : mesh.boundaries) count += boundary.edges.size();
  return count;
}

void expect_gmsh_agrees(const char* name, const WriteOptions& options, const char* output_format) {
  if (!runs("gmsh -version")) GTEST_SKIP() << "needs the program gmsh, which is not installed";
  const Scratch scratch;
  const FrozenMesh mesh = test::graded_ring(24, 6);
  write_mesh(mesh, scratch / name, options);
  const auto out = scratch / (std::string("out.") + (output_format == std::string("su2") ? "su2" : "msh"));
  ASSERT_TRUE(
      runs("gmsh -0 " + (scratch / name).string() + " -format " + output_format + " -o " + out.string()));
  const FrozenMesh back = read_frozen_mesh(out);
  EXPECT_EQ(back.points.size(), mesh.points.size());
  EXPECT_EQ(back.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(edge_count(back), edge_count(mesh));
  ASSERT_EQ(back.boundaries.size(), 2U);
  EXPECT_EQ(back.boundaries[0].name, "inner");
  EXPECT_EQ(back.boundaries[1].name, "outer");
}

TEST(Gmsh, ReadsOurVersion41AndWeReadBothVersionsOfIts) {
  expect_gmsh_agrees("m.msh", {}, "msh41");
  expect_gmsh_agrees("m.msh", {}, "msh22");
}

TEST(Gmsh, ReadsOurVersion22) {
  expect_gmsh_agrees("m.msh", {.msh_version = 22}, "msh22");
  expect_gmsh_agrees("m.msh", {.msh_version = 22}, "msh41");
}

// Gmsh writes SU2's format but does not read it.
TEST(Gmsh, WritesAnSu2FileThatWeRead) {
  expect_gmsh_agrees("m.msh", {}, "su2");
}

}  // namespace
}  // namespace remodel
