// Gmsh as an oracle: it reads what we write, and we read what it writes from that.

#include <gtest/gtest.h>

#include <cstdlib>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/error.h"
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

// Gmsh writes SU2's format but does not read it.
TEST(Gmsh, WritesAnSu2FileThatWeRead) {
  expect_gmsh_agrees("m.msh", {}, "su2");
}

}  // namespace
}  // namespace remodel
