#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/io.h"
#include "support.h"

namespace remodel {
namespace {

using test::error_of;
using test::Scratch;

void expect_same_view(const FrozenMesh& a, const FrozenMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.quads, b.quads);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (std::size_t k = 0; k < a.boundaries.size(); ++k) {
    EXPECT_EQ(a.boundaries[k].name, b.boundaries[k].name);
    EXPECT_EQ(a.boundaries[k].edges, b.boundaries[k].edges);
  }
}

void expect_same_attributes(const FrozenMesh& a, const FrozenMesh& b) {
  EXPECT_EQ(a.length_scale, b.length_scale);
  EXPECT_EQ(a.vertex_ids, b.vertex_ids);
  EXPECT_EQ(a.triangle_ids, b.triangle_ids);
  EXPECT_EQ(a.birth, b.birth);
  EXPECT_EQ(a.curve, b.curve);
  EXPECT_EQ(a.parameter, b.parameter);
}

struct Target {
  const char* name;
  WriteOptions options;
};
const Target targets[] = {
    {"m.su2", {}}, {"m.msh", {}}, {"m.msh", {.msh_version = 22}}, {"m.vtu", {}}, {"m.vtkhdf", {}}};

TEST(MeshFiles, EveryFormatGivesBackThePointsCellsAndBoundariesExactly) {
  for (const auto& mesh : {test::square_ring(), test::graded_ring(40, 12), test::mixed_ring()}) {
    for (const auto& target : targets) {
      SCOPED_TRACE(target.name);
      const Scratch scratch;
      write_mesh(mesh, scratch / target.name, target.options);
      expect_same_view(read_frozen_mesh(scratch / target.name), mesh);
    }
  }
}

TEST(MeshFiles, VtkFormatsGiveBackWhatElseAMeshCarries) {
  const Scratch scratch;
  for (const char* name : {"m.vtu", "m.vtkhdf"}) {
    FrozenMesh mesh = test::full_square_ring();
    mesh.periodic = {{"below", "above"}, {"left", "right"}};
    write_mesh(mesh, scratch / name);
    const FrozenMesh back = read_frozen_mesh(scratch / name);
    expect_same_view(back, mesh);
    expect_same_attributes(back, mesh);
    EXPECT_EQ(back.periodic, mesh.periodic);
  }
}

TEST(MeshFiles, TheSameMeshGivesTheSameBytes) {
  const Scratch scratch;
  for (const auto& target : targets) {
    write_mesh(test::full_square_ring(), scratch / target.name, target.options);
    const std::string first = read_text(scratch / target.name);
    write_mesh(test::full_square_ring(), scratch / (std::string("again_") + target.name), target.options);
    EXPECT_EQ(read_text(scratch / (std::string("again_") + target.name)), first) << target.name;
  }
}

TEST(MeshFiles, AnUnknownExtensionListsTheKnownOnes) {
  EXPECT_EQ(error_of([] { mesh_format("a.stl"); }),
            "a.stl: extension '.stl' found, .vtkhdf, .su2, .msh, .vtu or .foam expected");
  EXPECT_EQ(error_of([] { mesh_format("mesh"); }),
            "mesh: no extension found, .vtkhdf, .su2, .msh, .vtu or .foam expected");
}

TEST(MeshFiles, ALargeMeshKeepsItsTriangles) {
  const Scratch scratch;
  const FrozenMesh mesh = test::graded_ring(275, 100);  // 55,000 triangles
  for (const auto& target : targets) {
    write_mesh(mesh, scratch / target.name, target.options);
    EXPECT_EQ(read_frozen_mesh(scratch / target.name).triangles, mesh.triangles);
  }
}

// ---------------------------------------------------------------------------------------- foreign meshes

TEST(ForeignMeshes, WrittenClockwiseAreTurnedAndEdgesPutDomainLeftInLoopOrder) {
  FrozenMesh mesh = test::square_ring();
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  auto& hole = mesh.boundaries[1].edges;
  std::swap(hole[1][0], hole[1][1]);
  std::swap(hole[1], hole[2]);
  const FrozenMesh back = io::parse_su2(io::su2_text(mesh, "m.su2"), "m.su2");
  EXPECT_EQ(back.triangles, test::square_ring().triangles);
  EXPECT_EQ(back.boundaries[1].edges, test::square_ring().boundaries[1].edges);
}

TEST(ForeignMeshes, WrittenClockwiseWithQuadrilateralsAreTurned) {
  FrozenMesh mesh = test::mixed_ring();
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  for (auto& [a, b, c, d] : mesh.quads) std::swap(b, d);
  expect_same_view(io::parse_su2(io::su2_text(mesh, "m.su2"), "m.su2"), test::mixed_ring());
}

TEST(ForeignMeshes, MayHaveCellsInAnyOrder) {
  const std::string su2 =
      "NDIME= 2\nNELEM= 3\n9 0 1 2 3\n5 1 4 2\n9 3 2 4 5\nNPOIN= 6\n0 0\n1 0\n1 1\n0 1\n2 0\n1 3\n"
      "NMARK= 0\n";
  const FrozenMesh mesh = io::parse_su2(su2, "m.su2");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{1, 4, 2}}));
  EXPECT_EQ(mesh.quads, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {3, 2, 4, 5}}));
  const std::string msh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"a\"\n2 2 \"b\"\n$EndPhysicalNames\n"
      "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n6 1 3 0\n$EndNodes\n"
      "$Elements\n3\n7 3 2 2 1 1 2 3 4\n8 2 2 1 1 2 5 3\n9 3 2 1 1 4 3 5 6\n$EndElements\n"
      "$ElementData\n1\n\"t\"\n1\n0\n3\n0\n1\n3\n7 70\n8 80\n9 90\n$EndElementData\n";
  const FrozenMesh same = io::parse_msh(msh, "m.msh");
  EXPECT_EQ(same.quads, mesh.quads);
  const auto name_of = [&](std::size_t cell) { return same.region_names[same.region[cell]]; };
  EXPECT_EQ(name_of(0) + name_of(1) + name_of(2), "aba");
  EXPECT_EQ(io::parse_msh_fields(msh, "m.msh").at(0).values, (std::vector<double>{80, 70, 90}));
}

TEST(ForeignMeshes, PixelsOfVtkAreQuadrilaterals) {
  std::string text = io::vtu_text(test::mixed_ring());
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), text.npos);
    text.replace(text.find(from), from.size(), to);
  };
  replace("\n0 1 5\n4 1 2\n6 5 ", "\n0 1 4\n5 1 2\n5 6 ");
  replace("9\n9\n", "8\n8\n");
  expect_same_view(io::parse_vtu(text, "m.vtu"), test::mixed_ring());
}

TEST(ForeignMeshes, KeepAnInvertedTriangleForTheCheckerToFind) {
  FrozenMesh mesh = test::square_ring();
  std::swap(mesh.triangles[2][1], mesh.triangles[2][2]);
  EXPECT_EQ(io::parse_su2(io::su2_text(mesh, "m.su2"), "m.su2").triangles, mesh.triangles);
}

TEST(ForeignMeshes, Su2ReadsPointsBeforeElementsCommentsCarriageReturnsAndRepeatedCounts) {
  const std::string text =
      "% a comment\r\nNDIME = 2\r\nNPOIN= 4 4\r\n0 0\r\n1 0 1\r\n1 1 2\r\n0 1 3 % last\r\n"
      "NELEM=2\r\n5 0 1 2 0\r\n5 0 2 3\r\nNMARK= 1\r\nMARKER_TAG= wall\r\nMARKER_ELEMS= 2\r\n3 0 1\r\n3 1 2 "
      "1\r\n"
      "FFD_NBOX= 1\r\nFFD_CORNER_POINTS= 1\r\n0.0 0.5\r\n";
  const FrozenMesh mesh = io::parse_su2(text, "m.su2");
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  ASSERT_EQ(mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.boundaries[0].name, "wall");
  EXPECT_EQ(mesh.boundaries[0].edges.size(), 2U);
}

TEST(ForeignMeshes, TheSu2TutorialMeshHasItsCountsAndClosedLoops) {
  REMODEL_SHARED_FILE(file, "meshes/mesh_NACA0012_inv.su2");
  const FrozenMesh mesh = read_frozen_mesh(file);
  EXPECT_EQ(mesh.points.size(), 5233U);
  EXPECT_EQ(mesh.triangles.size(), 10216U);
  std::map<std::string, std::size_t> edges;
  for (const auto& boundary : mesh.boundaries) {
    edges[boundary.name] = boundary.edges.size();
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
      EXPECT_EQ(boundary.edges[i][1], boundary.edges[(i + 1) % boundary.edges.size()][0]);
    }
  }
  EXPECT_EQ(edges, (std::map<std::string, std::size_t>{{"airfoil", 200}, {"farfield", 50}}));
}

TEST(ForeignMeshes, GmshFilesWithSparseTagsEntitiesAndUnknownSectionsAreRead) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\nanything $Nodes\n$EndComments\n"
      "$PhysicalNames\n2\n1 7 \"lower wall\"\n2 9 \"air\"\n$EndPhysicalNames\n"
      "$Entities\n1 2 1 0\n5 0 0 0 0\n1 0 0 0 1 0 0 1 7 2 5 -5\n2 0 0 0 1 1 0 0 2 5 -5\n"
      "1 0 0 0 1 1 0 1 9 2 1 2\n$EndEntities\n"
      "$Nodes\n2 4 10 4000000000\n1 1 1 2\n10\n20\n0 0 0 0.0\n1 0 0 1.0\n2 1 0 2\n30\n4000000000\n1 1 0\n0 1 "
      "0\n$EndNodes\n"
      "$Elements\n4 5 1 5\n0 5 15 1\n1 10\n1 1 1 1\n2 10 20\n1 2 1 1\n3 20 30\n2 1 2 2\n4 10 20 30\n5 10 30 "
      "4000000000\n"
      "$EndElements\n";
  const FrozenMesh mesh = io::parse_msh(text, "m.msh");
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  ASSERT_EQ(mesh.boundaries.size(), 2U);
  EXPECT_EQ(mesh.boundaries[0].name, "lower wall");
  EXPECT_EQ(mesh.boundaries[1].name, "curve_2");
}

const std::string vtu_frame_start =
    "<?xml version='1.0'?><!-- by hand --><VTKFile type='UnstructuredGrid' version='0.1' "
    "byte_order='LittleEndian'><UnstructuredGrid>"
    "<Piece NumberOfPoints='3' NumberOfCells='1'><PointData/><Points>";

TEST(ForeignMeshes, VtuInlineBinaryIsRead) {
  // 32-bit headers; Float32 points (0,0,0) (1,0,0) (0,1,0); Int32 cells; UInt8 types.
  const std::string text =
      vtu_frame_start +
      "<DataArray type='Float32' NumberOfComponents='3' format='binary'>\n"
      "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==\n</DataArray></Points><Cells>"
      "<DataArray type='Int32' Name='connectivity' format='binary'>DAAAAAAAAAABAAAAAgAAAA==</DataArray>"
      "<DataArray type='Int32' Name='offsets' format='binary'>BAAAAAMAAAA=</DataArray>"
      "<DataArray type='UInt8' Name='types' format='binary'>AQAAAAU=</DataArray>"
      "</Cells></Piece></UnstructuredGrid></VTKFile>";
  const FrozenMesh mesh = io::parse_vtu(text, "m.vtu");
  EXPECT_EQ(mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(mesh.triangles.size(), 1U);
}

TEST(ForeignMeshes, VtuAppendedBase64IsRead) {
  const std::string text =
      vtu_frame_start +
      "<DataArray type='Float32' NumberOfComponents='3' format='appended' offset='0'/></Points><Cells>"
      "<DataArray type='Int32' Name='connectivity' format='appended' offset='56'/>"
      "<DataArray type='Int32' Name='offsets' format='appended' offset='80'/>"
      "<DataArray type='UInt8' Name='types' format='ascii'>5</DataArray>"
      "</Cells></Piece></UnstructuredGrid><AppendedData encoding='base64'>\n  _"
      "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="
      "DAAAAAAAAAABAAAAAgAAAA=="
      "BAAAAAMAAAA=\n</AppendedData></VTKFile>";
  EXPECT_EQ(io::parse_vtu(text, "m.vtu").points, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}}));
}

// Readers that are not VTK's know numbers alone.
TEST(MeshFiles, VtuHasNoArraysOfStringsButReadsThem) {
  std::string text = io::vtu_text(test::square_ring());
  EXPECT_EQ(text.find("String"), std::string::npos);
  EXPECT_EQ(text.find("<Array"), std::string::npos);
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("<DataArray type=\"UInt8\" Name=\"boundary_names\"",
          "<Array type=\"String\" Name=\"boundary_names\"");
  replace("</DataArray>", "</Array>");
  expect_same_view(io::parse_vtu(text, "m.vtu"), test::square_ring());
}

FrozenMesh ring_of_regions() {
  FrozenMesh mesh = test::graded_ring(40, 12);
  mesh.region_names = {"near the wall", "far & away", "rim"};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    mesh.region.push_back(3 * i / static_cast<std::uint32_t>(mesh.triangles.size()));
  return mesh;
}

TEST(MeshFiles, EveryFormatButSu2KeepsRegions) {
  const FrozenMesh quads = test::mixed_ring();
  for (const auto& target : targets) {
    if (mesh_format(target.name) == MeshFormat::su2) continue;
    const Scratch scratch;
    write_mesh(quads, scratch / target.name, target.options);
    EXPECT_EQ(read_frozen_mesh(scratch / target.name).region, quads.region);
    EXPECT_EQ(read_frozen_mesh(scratch / target.name).region_names, quads.region_names);
  }
  FrozenMesh mesh = ring_of_regions();
  for (const bool mixed : {false, true}) {
    for (std::uint32_t i = 0; i < mesh.region.size() && mixed; ++i) mesh.region[i] = i % 7 % 3;
    for (const auto& target : targets) {
      SCOPED_TRACE(target.name);
      const Scratch scratch;
      write_mesh(mesh, scratch / target.name, target.options);
      const FrozenMesh back = read_frozen_mesh(scratch / target.name);
      expect_same_view(back, mesh);
      const bool su2 = mesh_format(target.name) == MeshFormat::su2;
      EXPECT_EQ(back.region, su2 ? std::vector<std::uint32_t>{} : mesh.region);
      EXPECT_EQ(back.region_names, su2 ? std::vector<std::string>{} : mesh.region_names);
    }
  }
}

TEST(MeshFiles, EveryFormatKeepsWhichPointsAreSteinerPoints) {
  FrozenMesh mesh = test::graded_ring(40, 12);
  mesh.steiner.assign(mesh.points.size(), 0);
  for (std::size_t i = 0; i < 40; i += 1 + i % 3) mesh.steiner[i] = 1;
  for (const auto& target : targets) {
    SCOPED_TRACE(target.name);
    const Scratch scratch;
    write_mesh(mesh, scratch / target.name, target.options);
    EXPECT_EQ(read_frozen_mesh(scratch / target.name).steiner, mesh.steiner);
  }
}

TEST(MeshFiles, NotesOnSteinerPointsOfAnotherMeshArePassedOver) {
  FrozenMesh mesh = test::square_ring();
  const std::string text = io::su2_text(mesh, "m.su2");
  for (const char* note :
       {"of 9: 1 2", "of 8: 9", "of", "of 8", "of x: 1", "of 99999999999999999999999: 1"}) {
    const FrozenMesh back = io::parse_su2(text + "% remodel: Steiner points " + note + "\n", "m.su2");
    EXPECT_EQ(std::count(back.steiner.begin(), back.steiner.end(), 1), 0) << note;
  }
  EXPECT_EQ(io::parse_su2(text + "% remodel: Steiner points of 8: 1 7 8 2\n", "m.su2").steiner,
            (std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0, 0, 1}));
}

TEST(MeshFiles, Su2HasNoMarkersInsideTheMeshUnlessAskedFor) {
  FrozenMesh mesh = test::square_ring();
  mesh.boundaries.push_back({"wake", {{4, 1}, {5, 2}}});
  mesh.boundaries[0].edges.push_back({2, 6});  // of two kinds under one name
  EXPECT_EQ(inner_curves(mesh), (std::vector<std::string>{"outer", "wake"}));
  EXPECT_EQ(inner_curves(test::square_ring()), std::vector<std::string>{});
  const Scratch scratch;
  write_mesh(mesh, scratch / "m.su2");
  expect_same_view(read_frozen_mesh(scratch / "m.su2"), test::square_ring());
  write_mesh(mesh, scratch / "m.su2", {.inner = InnerCurves::markers});
  EXPECT_EQ(read_frozen_mesh(scratch / "m.su2").boundaries.size(), 3U);
  for (const char* name : {"m.msh", "m.vtu", "m.vtkhdf"}) {
    write_mesh(mesh, scratch / name);
    EXPECT_EQ(read_frozen_mesh(scratch / name).boundaries.size(), 3U) << name;
  }
}

TEST(MeshFiles, BoundaryNamesWithMarkupSurviveVtuAndMsh) {
  FrozenMesh mesh = test::square_ring();
  mesh.boundaries[0].name = "a <b> & 'c' \xc3\xa9";
  const Scratch scratch;
  for (const char* name : {"m.vtu", "m.vtkhdf", "m.msh"}) {
    write_mesh(mesh, scratch / name);
    EXPECT_EQ(read_frozen_mesh(scratch / name).boundaries[0].name, mesh.boundaries[0].name) << name;
  }
  mesh.boundaries[0].name = "50%";
  EXPECT_NE(error_of([&] { write_mesh(mesh, scratch / "m.su2"); }).find("SU2 expects one without '%'"),
            std::string::npos);
}

TEST(MeshFiles, OfSu2AndOpenFoamHaveUnderscoresInThePlaceOfBlanksInNames) {
  FrozenMesh mesh = test::square_ring();
  mesh.boundaries[0].name = "upper  wall";
  const Scratch scratch;
  write_mesh(mesh, scratch / "m.su2");
  EXPECT_EQ(read_frozen_mesh(scratch / "m.su2").boundaries[0].name, "upper__wall");
  write_mesh(mesh, scratch / "m.foam");
  const std::string patches = read_text(scratch / "constant" / "polyMesh" / "boundary");
  EXPECT_NE(patches.find("    upper__wall\n"), patches.npos);
  EXPECT_EQ(patches.find("upper  wall"), patches.npos);
  EXPECT_EQ(name_in(MeshFormat::foam, "upper wall"), "upper_wall");
  EXPECT_EQ(name_in(MeshFormat::msh, "upper wall"), "upper wall");
  mesh.boundaries[1].name = "upper _wall";
  for (const char* name : {"m.su2", "m.foam"})
    EXPECT_NE(error_of([&] {
                write_mesh(mesh, scratch / name);
              }).find("boundaries 'upper  wall' and 'upper _wall' found, which would both be 'upper__wall'"),
              std::string::npos)
        << name;
}

TEST(ForeignMeshes, NamesOfBoundariesMayBeAnArrayOfTexts) {
  std::string text = io::vtu_text(test::square_ring());
  const std::string codes = "<DataArray type=\"UInt8\" Name=\"boundary_names\" NumberOfTuples=\"11\"";
  const auto at = text.find(codes);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, codes.size(), "<Array type=\"String\" Name=\"boundary_names\" NumberOfTuples=\"2\"");
  text.replace(text.find("</DataArray>", at), 12, "</Array>");
  expect_same_view(io::parse_vtu(text, "m.vtu"), test::square_ring());
}

}  // namespace
}  // namespace remodel
