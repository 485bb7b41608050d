// Gmsh as an oracle: it reads what we write, and we read what it writes from that.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/error.h"
#include "remodel/import.h"
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

void expect_gmsh_agrees(const char* name, const WriteOptions& options, const char* output_format,
                        const char* more = "") {
  if (!runs("gmsh -version")) GTEST_SKIP() << "needs the program gmsh, which is not installed";
  const Scratch scratch;
  const FrozenMesh mesh = test::graded_ring(24, 6);
  write_mesh(mesh, scratch / name, options);
  const auto out = scratch / (std::string("out.") + (output_format == std::string("su2") ? "su2" : "msh"));
  ASSERT_TRUE(runs("gmsh -0 " + (scratch / name).string() + " -format " + output_format + " -o " +
                   out.string() + " " + more));
  const FrozenMesh back = read_frozen_mesh(out);
  EXPECT_EQ(back.points.size(), mesh.points.size());
  EXPECT_EQ(back.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(edge_count(back), edge_count(mesh));
  const bool exact = *more != '\0';  // text of gmsh's has 16 digits
  EXPECT_TRUE(!exact || back.points == mesh.points);
  ASSERT_EQ(back.boundaries.size(), 2U);
  EXPECT_EQ(back.boundaries[0].name, "inner");
  EXPECT_EQ(back.boundaries[1].name, "outer");
}

TEST(Gmsh, ReadsOurVersion41AndWeReadBothVersionsOfIts) {
  expect_gmsh_agrees("m.msh", {}, "msh41");
  expect_gmsh_agrees("m.msh", {}, "msh22");
}

TEST(Gmsh, WritesVersion40ThatWeRead) {
  expect_gmsh_agrees("m.msh", {}, "msh40");
}

TEST(Gmsh, ReadsOurVersion22) {
  expect_gmsh_agrees("m.msh", {.msh_version = 22}, "msh22");
  expect_gmsh_agrees("m.msh", {.msh_version = 22}, "msh41");
}

TEST(Gmsh, WritesBinaryFilesOfBothVersionsThatWeRead) {
  expect_gmsh_agrees("m.msh", {}, "msh41", "-bin");
  expect_gmsh_agrees("m.msh", {}, "msh22", "-bin");
}

// A binary file that is cut off anywhere, or damaged, is refused in one line or read as something else; never
// more.
TEST(Gmsh, DamagedBinaryFilesAreRefused) {
  if (!runs("gmsh -version")) GTEST_SKIP() << "needs the program gmsh, which is not installed";
  const Scratch scratch;
  write_mesh(test::graded_ring(12, 3), scratch / "m.msh");
  for (const std::string format : {"msh41", "msh22"}) {
    const auto file = scratch / (format + ".msh");
    ASSERT_TRUE(
        runs("gmsh -0 " + (scratch / "m.msh").string() + " -bin -format " + format + " -o " + file.string()));
    const std::string text = read_text(file);
    const auto read = [&](const std::string& changed) {
      try {
        io::parse_msh(changed, "damaged.msh");
        return true;
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return false;
      }
    };
    ASSERT_TRUE(read(text));
    for (std::size_t size = 0; size + 20 < text.size(); size += 7) EXPECT_FALSE(read(text.substr(0, size)));
    for (std::size_t i = 0; i < text.size(); i += 3) {
      std::string changed = text;
      changed[i] = static_cast<char>(changed[i] ^ 0x55);
      read(changed);
    }
  }
}

// Two physical surfaces, a surface in no group, and a curve that a group names though it lies inside.
TEST(Gmsh, RegionsAndCurvesInsideAreRead) {
  if (!runs("gmsh -version")) GTEST_SKIP() << "needs the program gmsh, which is not installed";
  const Scratch scratch;
  write_text_atomically(scratch / "two.geo", R"(
    h = 0.3;
    Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0, 0, h}; Point(4) = {3, 0, 0, h};
    Point(5) = {3, 1, 0, h}; Point(6) = {2, 1, 0, h}; Point(7) = {1, 1, 0, h}; Point(8) = {0, 1, 0, h};
    Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7};
    Line(7) = {7, 8}; Line(8) = {8, 1}; Line(9) = {2, 7}; Line(10) = {3, 6};
    Curve Loop(1) = {1, 9, 7, 8}; Curve Loop(2) = {2, 10, 6, -9}; Curve Loop(3) = {3, 4, 5, -10};
    Plane Surface(1) = {1}; Plane Surface(2) = {2}; Plane Surface(3) = {3};
    Physical Surface("water") = {1}; Physical Surface("oil & gas") = {2, 3};
    Physical Curve("wall") = {1, 2, 3, 4, 5, 6, 7, 8}; Physical Curve("gauge") = {10};
    )");
  for (const std::string format : {"msh41", "msh40", "msh22"}) {
    for (const std::string more : {"", " -bin"}) {
      if (format == "msh40" && !more.empty()) continue;  // which Gmsh does not write
      SCOPED_TRACE(format + more);
      ASSERT_TRUE(runs("gmsh -2 " + (scratch / "two.geo").string() + " -format " + format + more + " -o " +
                       (scratch / "two.msh").string()));
      const FrozenMesh mesh = read_frozen_mesh(scratch / "two.msh");
      EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"water", "oil & gas"}));
      EXPECT_EQ(inner_curves(mesh), std::vector<std::string>{"gauge"});
      const Mesh living = import_mesh(mesh, "two.msh").mesh;
      EXPECT_EQ(living.quick_check(), "");
      const FrozenMesh back = living.freeze();
      EXPECT_EQ(inner_curves(back), (std::vector<std::string>{"gauge", "interface"}));
      write_mesh(back, scratch / "back.msh");
      ASSERT_TRUE(runs("gmsh -0 " + (scratch / "back.msh").string() + " -format msh22 -o " +
                       (scratch / "again.msh").string()));
      const FrozenMesh again = read_frozen_mesh(scratch / "again.msh");
      ASSERT_EQ(again.region_names, mesh.region_names);
      EXPECT_EQ(std::count(again.region.begin(), again.region.end(), 0U),
                std::count(mesh.region.begin(), mesh.region.end(), 0U));
    }
  }
}

// Gmsh writes SU2's format but does not read it.
TEST(Gmsh, WritesAnSu2FileThatWeRead) {
  expect_gmsh_agrees("m.msh", {}, "su2");
}

}  // namespace
}  // namespace remodel
