// Points that no cell uses: files of other programs have them, the view does not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/check.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using test::Scratch;

// The mesh with a point at the beginning and one in the middle that nothing uses.
FrozenMesh with_unused(FrozenMesh mesh) {
  const auto number = [](std::uint32_t& v) { v += v < 3 ? 1 : 2; };
  for (auto& triangle : mesh.triangles) std::for_each(triangle.begin(), triangle.end(), number);
  for (auto& quad : mesh.quads) std::for_each(quad.begin(), quad.end(), number);
  for (auto& boundary : mesh.boundaries)
    for (auto& edge : boundary.edges) std::for_each(edge.begin(), edge.end(), number);
  const auto insert = [](auto& values, auto value) {
    if (values.empty()) return;
    values.insert(values.begin() + 3, value);
    values.insert(values.begin(), value);
  };
  insert(mesh.points, Point{70.0, -3.0});
  insert(mesh.length_scale, 5.0);
  insert(mesh.vertex_ids, 500U);
  insert(mesh.vertex_keys, std::uint64_t{5000});
  insert(mesh.curve, -1);
  insert(mesh.parameter, 0.0);
  insert(mesh.steiner, std::uint8_t{1});
  return mesh;
}

const std::vector<std::uint32_t> kept = {1, 2, 3, 5, 6, 7, 8, 9};

// 1, 2, ... on the points that are used, 99 on the others; and a field on cells.
std::vector<Field> fields_with_unused(const FrozenMesh& mesh) {
  std::vector<Field> fields = {
      {"u", FieldPlace::vertices, 2, std::vector<double>(2 * mesh.points.size(), 99.0)},
      {"c", FieldPlace::triangles, 1, std::vector<double>(mesh.cell_count(), 0.5)}};
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      fields[0].values[2 * kept[i] + k] = static_cast<double>(2 * i + k + 1);
  return fields;
}

void expect_same(const FrozenMesh& a, const FrozenMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.quads, b.quads);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (std::size_t k = 0; k < a.boundaries.size(); ++k)
    EXPECT_EQ(a.boundaries[k].edges, b.boundaries[k].edges);
}

struct UnusedTarget {
  const char* name;
  int msh_version = 41;
};
const UnusedTarget unused_targets[] = {{"m.vtu"}, {"m.vtkhdf"}, {"m.msh"}, {"m.msh", 22}, {"m.su2"}};

TEST(UnusedPoints, AreLeftOutOfTheMeshAndOfItsFieldsWithANote) {
  for (const FrozenMesh& mesh : {test::full_square_ring(), test::mixed_ring()})
    for (const auto& [name, version] : unused_targets) {
      SCOPED_TRACE(name);
      const Scratch scratch;
      const FrozenMesh more = with_unused(mesh);
      const bool has_fields = std::string(name) != "m.su2";
      const std::vector<Field> fields = has_fields ? fields_with_unused(more) : std::vector<Field>();
      write_mesh(more, scratch / name, {.msh_version = version, .fields = fields});
      ReadNotes notes;
      const FrozenMesh back = read_frozen_mesh(scratch / name, &notes);
      expect_same(back, mesh);
      EXPECT_EQ(check(back).valid, check(mesh).valid);
      EXPECT_EQ(notes.unused_points, 2U);
      EXPECT_EQ(notes.kept_points, kept);
      ASSERT_EQ(notes.warnings.size(), 1U);
      EXPECT_EQ(notes.warnings[0], (scratch / name).string() + ": 2 points that no cell uses are left out");
      if (!has_fields) continue;
      const std::vector<Field> found = read_fields(scratch / name);
      ASSERT_EQ(found.size(), 2U);
      EXPECT_EQ(found[0].values,
                (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
      EXPECT_EQ(found[1].values, fields[1].values);
    }
}

TEST(UnusedPoints, TakeWhatIsSaidOfThemAlong) {
  FrozenMesh mesh = test::full_square_ring();
  mesh.vertex_keys = {1, 2, 3, 4, 5, 6, 7, 8};
  mesh.steiner = {0, 1, 0, 0, 0, 0, 1, 0};
  for (const auto& [name, version] : unused_targets) {
    SCOPED_TRACE(name);
    const Scratch scratch;
    write_mesh(with_unused(mesh), scratch / name, {.msh_version = version});
    const FrozenMesh back = read_frozen_mesh(scratch / name);
    EXPECT_EQ(back.steiner, mesh.steiner);
    const std::string extension = std::filesystem::path(name).extension();
    EXPECT_EQ(back.vertex_keys, extension == ".su2" ? std::vector<std::uint64_t>() : mesh.vertex_keys);
    if (extension == ".su2" || extension == ".msh") continue;
    EXPECT_EQ(back.length_scale, mesh.length_scale);
    EXPECT_EQ(back.vertex_ids, mesh.vertex_ids);
    EXPECT_EQ(back.curve, mesh.curve);
    EXPECT_EQ(back.parameter, mesh.parameter);
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

TEST(UnusedPoints, MayLieOutsideThePlaneAndHaveNoValues) {
  const FrozenMesh more = with_unused(test::square_ring());
  std::string msh = io::msh_text(more, 41, "m.msh", fields_with_unused(more));
  msh = replaced(msh, "\n70 -3 0\n", "\n70 -3 4\n");
  msh = replaced(msh, "\n0\n3\n10\n1 99 99 0\n", "\n0\n3\n9\n");
  expect_same(io::parse_msh(msh, "m.msh"), test::square_ring());
  const std::vector<Field> found = io::parse_msh_fields(msh, "m.msh");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].values.size(), 16U);
  const std::string vtu = replaced(io::vtu_text(more), "\n70 -3 0\n", "\n70 -3 4\n");
  expect_same(io::parse_vtu(vtu, "m.vtu"), test::square_ring());
}

TEST(UnusedPoints, OfSurfacesInBoxesLoseTheirNumbers) {
  const std::string boxes = "FFD_NBOX= 1\nFFD_SURFACE_POINTS= 1\nouter 1 0.5 0.5 0\n";
  ReadNotes notes;
  io::parse_su2(io::su2_text(with_unused(test::square_ring()), "m.su2", InnerCurves::left_out, boxes),
                "m.su2", &notes);
  EXPECT_EQ(notes.su2_boxes, "FFD_NBOX= 1\nFFD_SURFACE_POINTS= 0\n");
  EXPECT_EQ(notes.warnings.size(), 2U);
}

TEST(UnusedPoints, TakeLinesAlongThatEndThere) {
  FrozenMesh mesh = with_unused(test::square_ring());
  mesh.boundaries[0].edges.push_back({0, 1});
  mesh.boundaries.push_back({"construction", {{0, 4}, {4, 0}}});
  for (const auto& [name, version] : unused_targets) {
    SCOPED_TRACE(name);
    const Scratch scratch;
    write_mesh(mesh, scratch / name, {.msh_version = version});
    ReadNotes notes;
    expect_same(read_frozen_mesh(scratch / name, &notes), test::square_ring());
    ASSERT_EQ(notes.warnings.size(), 1U);
    EXPECT_NE(notes.warnings[0].find("2 points that no cell uses are left out, and 3 lines that end there"),
              std::string::npos);
  }
}

// The centre of an arc, which Gmsh meshes by a node where everything is saved, and a line of the drawing.
TEST(UnusedPoints, OfGmshAreLeftOut) {
  if (std::system("gmsh -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs the program gmsh, which is not installed";
  const Scratch scratch;
  write_text_atomically(scratch / "disc.geo", R"(
    Point(1) = {0, 0, 0, 0.3}; Point(2) = {1, 0, 0, 0.3}; Point(3) = {-1, 0, 0, 0.3};
    Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2}; Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};
    Point(4) = {0, 3, 0, 0.3}; Line(3) = {2, 4};
    Mesh.SaveAll = 1;
    )");
  for (const std::string format : {"msh41", "msh22"}) {
    const std::string command = "gmsh -2 " + (scratch / "disc.geo").string() + " -format " + format + " -o " +
                                (scratch / "disc.msh").string() + " >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    ReadNotes notes;
    EXPECT_TRUE(check(read_frozen_mesh(scratch / "disc.msh", &notes)).valid);
    EXPECT_GT(notes.unused_points, 5U);
  }
}

}  // namespace
}  // namespace remodel
