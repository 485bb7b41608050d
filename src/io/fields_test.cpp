// Fields in files: they come back as they were, and other programs read them.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <random>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "support.h"

namespace remodel {

bool operator==(const Field& a, const Field& b) {
  return a.name == b.name && a.place == b.place && a.components == b.components && a.values == b.values;
}
void PrintTo(const Field& field, std::ostream* out) {
  *out << field.name << " with " << field.values.size() << " values";
}

namespace {

using test::error_of;
using test::Scratch;

// In the order of read_fields().
std::vector<Field> fields_on(const FrozenMesh& mesh) {
  const auto seed = test::seed(5);
  std::mt19937_64 random(seed);
  std::vector<Field> fields = {{"mach", FieldPlace::vertices, 1, {}},
                               {"momentum", FieldPlace::vertices, 3, {}},
                               {"cell speed", FieldPlace::triangles, 3, {}},
                               {"shock", FieldPlace::triangles, 1, {}}};
  for (Field& field : fields) {
    const std::size_t places = field.place == FieldPlace::vertices ? mesh.points.size() : mesh.cell_count();
    for (std::size_t i = 0; i < places * static_cast<std::size_t>(field.components); ++i)
      field.values.push_back(std::uniform_real_distribution(-2.0, 2.0)(random));
  }
  fields[0].values[1] = 1e-300;
  fields[0].values[2] = 1.0 / 3.0;
  return fields;
}

struct Target {
  const char* name;
  int msh_version = 41;
};
const Target targets[] = {{"m.vtu"}, {"m.vtkhdf"}, {"m.msh"}, {"m.msh", 22}};

TEST(FieldFiles, GiveBackEveryValueExactlyAndTheMeshUnchanged) {
  for (const FrozenMesh& mesh : {test::graded_ring(24, 6), test::mixed_ring()})
    for (const auto& [name, version] : targets) {
      SCOPED_TRACE(name);
      const std::vector<Field> fields = fields_on(mesh);
      const Scratch scratch;
      write_mesh(mesh, scratch / name, {.msh_version = version, .fields = fields});
      EXPECT_EQ(read_fields(scratch / name), fields);
      EXPECT_EQ(read_frozen_mesh(scratch / name).triangles, mesh.triangles);
      EXPECT_EQ(read_frozen_mesh(scratch / name).quads, mesh.quads);
      EXPECT_EQ(read_frozen_mesh(scratch / name).points, mesh.points);
    }
}

TEST(FieldFiles, AFileWithoutFieldsHasNoneAndTheSameBytesAsBefore) {
  const Scratch scratch;
  const FrozenMesh mesh = test::full_square_ring();
  for (const auto& [name, version] : targets) {
    write_mesh(mesh, scratch / name, {.msh_version = version});
    EXPECT_TRUE(read_fields(scratch / name).empty()) << name;
  }
  write_mesh(mesh, scratch / "m.su2");
  EXPECT_TRUE(read_fields(scratch / "m.su2").empty());
  EXPECT_THROW(read_fields(scratch / "none.su2"), Error);
}

// A vector of two components, one of three that lies in the plane, and one in cells.
std::vector<Field> vectors_on(const FrozenMesh& mesh) {
  std::vector<Field> fields = {{"u", FieldPlace::vertices, 2, {}},
                               {"v", FieldPlace::vertices, 3, {}},
                               {"w", FieldPlace::triangles, 2, {}}};
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double x = static_cast<double>(i);
    fields[0].values.insert(fields[0].values.end(), {x, x + 0.5});
    fields[1].values.insert(fields[1].values.end(), {x, x + 0.5, 0.0});
  }
  for (std::size_t i = 0; i < 2 * mesh.cell_count(); ++i)
    fields[2].values.push_back(0.25 * static_cast<double>(i));
  return fields;
}

TEST(FieldFiles, VectorsOfThePlaneAreArraysOfThreeComponentsAndComeBackAsTheyWere) {
  for (const FrozenMesh& mesh : {test::square_ring(), test::mixed_ring(), test::full_square_ring()})
    for (const auto& [name, version] : targets) {
      SCOPED_TRACE(name);
      const std::vector<Field> fields = vectors_on(mesh);
      const Scratch scratch;
      write_mesh(mesh, scratch / name, {.msh_version = version, .fields = fields});
      EXPECT_EQ(read_fields(scratch / name), fields);
    }
  const std::string vtu = io::vtu_text(test::square_ring(), vectors_on(test::square_ring()));
  EXPECT_EQ(vtu.find("NumberOfComponents=\"2\""), vtu.npos);
  EXPECT_EQ(vtu.find("NumberOfComponents=\"1\""), vtu.npos);
  EXPECT_NE(vtu.find("Name=\"u\" NumberOfComponents=\"3\" "), vtu.npos);
  EXPECT_NE(vtu.find("\n0 0.5 0\n1 1.5 0\n"), vtu.npos);
}

TEST(FieldFiles, VectorsOfOtherProgramsKeepThreeComponents) {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return at == text.npos ? text : text.replace(at, what.size(), by);
  };
  const FrozenMesh mesh = test::square_ring();
  const std::vector<Field> fields = {vectors_on(mesh).front()};
  const std::string vtu = io::vtu_text(mesh, fields), msh = io::msh_text(mesh, 41, "m.msh", fields);
  const auto components = [](const std::vector<Field>& found) { return found.at(0).components; };
  EXPECT_EQ(components(io::parse_vtu_fields(replaced(vtu, "remodel_components=\"2\" ", ""), "m.vtu")), 3);
  EXPECT_EQ(components(io::parse_vtu_fields(replaced(vtu, "\n1 1.5 0\n", "\n1 1.5 2\n"), "m.vtu")), 3);
  EXPECT_EQ(components(io::parse_msh_fields(msh.substr(0, msh.find("$Comments")), "m.msh")), 3);
  EXPECT_EQ(components(io::parse_msh_fields(replaced(msh, "\n2 1 1.5 0\n", "\n2 1 1.5 2\n"), "m.msh")), 3);
}

TEST(FieldFiles, ALivingMeshKeepsItsStateBesideTheFields) {
  Domain domain;
  domain.loops = {
      {LoopRole::outer, {{"wall", Polyline{{{0, 0}, {1, 0}, {0.3, 1}, {0, 0}}}, {0, 0.25, 0.5, 0.75}}}}};
  const Mesh mesh = generate(domain).mesh;
  const std::vector<Field> fields = fields_on(mesh.freeze());
  const Scratch scratch;
  write_mesh(mesh, scratch / "m.vtkhdf", {.fields = fields});
  EXPECT_EQ(read_fields(scratch / "m.vtkhdf"), fields);
  EXPECT_EQ(read_mesh(scratch / "m.vtkhdf").freeze().points, mesh.freeze().points);
}

TEST(FieldFiles, RefuseInOneSentenceWhatTheyCannotHold) {
  const FrozenMesh mesh = test::square_ring();
  const Scratch scratch;
  const auto refusal = [&](const char* file, const std::string& name, std::size_t count) {
    const std::vector<Field> fields = {{name, FieldPlace::vertices, 1, std::vector<double>(count)}};
    const std::string error = error_of([&] { write_mesh(mesh, scratch / file, {.fields = fields}); });
    EXPECT_FALSE(std::filesystem::exists(scratch / file)) << file;
    return error;
  };
  EXPECT_NE(refusal("m.su2", "mach", 8).find(".su2 has no place for them"), std::string::npos);
  for (const char* file : {"m.vtu", "m.vtkhdf", "m.msh"}) {
    EXPECT_EQ(refusal(file, "mach", 7), "field 'mach': 7 values found, 8 expected: 1 for each of 8 vertices");
  }
  for (const char* file : {"m.vtu", "m.vtkhdf"}) {
    EXPECT_NE(refusal(file, "parameter", 8).find("belongs to the mesh"), std::string::npos);
  }
  EXPECT_NE(refusal("m.vtkhdf", "a/b", 8).find("VTKHDF expects another"), std::string::npos);
  EXPECT_NE(refusal("m.msh", "a\"b", 8).find("without quotes"), std::string::npos);
}

TEST(FieldFiles, ABoundaryEdgeHasTheValueOfItsTriangleSoThatRangesAreTrue) {
  const FrozenMesh mesh = test::square_ring();
  const std::vector<Field> fields = {{"t", FieldPlace::triangles, 1, {10, 11, 12, 13, 14, 15, 16, 17}}};
  const std::string text = io::vtu_text(mesh, fields);
  const auto begin = text.find("\"t\"");
  // Eight triangles; the outer edges are of triangles 0, 2, 4 and 6, the hole's of 7, 5, 3 and 1.
  EXPECT_NE(text.find("10\n11\n12\n13\n14\n15\n16\n17\n10\n12\n14\n16\n17\n15\n13\n11\n<", begin),
            std::string::npos);
}

TEST(FieldFiles, WrongNumbersOfValuesAreNamedWithTheirPlace) {
  const std::vector<Field> fields = {{"mach", FieldPlace::vertices, 1, std::vector<double>(8, 0.5)}};
  std::string vtu = io::vtu_text(test::square_ring(), fields);
  vtu.insert(vtu.find("0.5"), "0.25 ");
  EXPECT_NE(error_of([&] {
              io::parse_vtu_fields(vtu, "m.vtu");
            }).find("9 values found in 'PointData/mach', 8 expected"),
            std::string::npos);
  EXPECT_EQ(error_of([&] { io::parse_vtu(vtu, "m.vtu"); }), "");  // the mesh itself is sound
  const std::string msh = io::msh_text(test::square_ring(), 41, "m.msh", fields);
  const auto data = msh.find("$NodeData");
  EXPECT_NE(error_of([&] { io::parse_msh_fields(msh.substr(0, msh.find("0.5", data) + 3), "m.msh"); }), "");
}

TEST(FieldFiles, OfGmshThatSayNothingOfSomeVerticesAreLeftOut) {
  const std::vector<Field> fields = {{"mach", FieldPlace::vertices, 1, std::vector<double>(8, 0.5)}};
  std::string msh = io::msh_text(test::square_ring(), 41, "m.msh", fields);
  const auto count = msh.find("\n8\n", msh.find("$NodeData"));
  msh.replace(count, 3, "\n7\n");
  msh.erase(msh.find("\n8 0.5"), 6);
  EXPECT_TRUE(io::parse_msh_fields(msh, "m.msh").empty());
}

// ------------------------------------------------------------------------------------------ other programs

bool runs(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(FieldFiles, AreReadByMeshioWithTheSameValues) {
  const std::string python = "/usr/bin/python3 -c ";
  if (!runs(python + "'import meshio'")) GTEST_SKIP() << "needs python3-meshio, which is not installed";
  const FrozenMesh mesh = test::graded_ring(24, 6);
  const std::vector<Field> fields = fields_on(mesh);
  for (const auto& [name, version] : targets) {
    // meshio knows no VTKHDF, and 5.0 takes values on elements of version 2.2 for something else.
    if (name == std::string("m.vtkhdf") || version == 22) continue;
    const Scratch scratch;
    write_mesh(mesh, scratch / name, {.msh_version = version, .fields = fields});
    std::ofstream(scratch / "expected.txt")
        << std::setprecision(17) << fields[0].values[7] << ' ' << fields[1].values[22] << ' '
        << fields[2].values[31] << ' ' << fields[3].values[9];
    const std::string program =
        "'import meshio, sys\n"
        "mesh = meshio.read(sys.argv[1])\n"
        "cells = [i for i, block in enumerate(mesh.cells) if block.type == \"triangle\"]\n"
        "assert len(cells) == 1, mesh\n"
        "data = mesh.point_data, {k: v[cells[0]] for k, v in mesh.cell_data.items()}\n"
        "found = [data[0][\"mach\"][7], data[0][\"momentum\"][7][1], data[1][\"cell speed\"][10][1],\n"
        "         data[1][\"shock\"][9]]\n"
        "assert found == [float(w) for w in open(sys.argv[2]).read().split()], found' ";
    EXPECT_TRUE(
        runs(python + program + (scratch / name).string() + " " + (scratch / "expected.txt").string()))
        << name << " " << version;
  }
}

TEST(FieldFiles, OfMeshioAreReadByUs) {
  const std::string python = "/usr/bin/python3 -c ";
  if (!runs(python + "'import meshio'")) GTEST_SKIP() << "needs python3-meshio, which is not installed";
  const std::string program =
      "'import meshio, sys\n"
      "points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\n"
      "mesh = meshio.Mesh(points, [(\"triangle\", [[0, 1, 2], [0, 2, 3]])],\n"
      "    point_data={\"p\": [0.5, 1.5, 2.5, 3.5]}, cell_data={\"q\": [[7.25, 8.25]]})\n"
      "mesh.write(sys.argv[1], **eval(sys.argv[2]))' ";
  const std::vector<Field> expected = {{"p", FieldPlace::vertices, 1, {0.5, 1.5, 2.5, 3.5}},
                                       {"q", FieldPlace::triangles, 1, {7.25, 8.25}}};
  const std::pair<const char*, const char*> files[] = {{"a.vtu", "dict(binary=False)"},
                                                       {"b.vtu", "dict(compression=None)"},
                                                       {"d.msh", "dict(file_format=\"gmsh\",binary=False)"},
                                                       {"e.msh", "dict(file_format=\"gmsh\",binary=True)"},
                                                       {"f.msh", "dict(file_format=\"gmsh22\",binary=True)"}};
  for (const auto& [name, options] : files) {
    const Scratch scratch;
    ASSERT_TRUE(runs(python + program + (scratch / name).string() + " '" + options + "'")) << name;
    EXPECT_EQ(read_fields(scratch / name), expected) << name;
  }
}

TEST(FieldFiles, AreViewsToGmsh) {
  if (!runs("gmsh -version")) GTEST_SKIP() << "needs the program gmsh, which is not installed";
  const FrozenMesh mesh = test::graded_ring(24, 6);
  const std::vector<Field> fields = fields_on(mesh);
  for (const int version : {41, 22}) {
    const Scratch scratch;
    write_mesh(mesh, scratch / "m.msh", {.msh_version = version, .fields = fields});
    std::ofstream(scratch / "m.geo") << "Merge \"m.msh\";\n"
                                        "Printf(\"%g\", PostProcessing.NbViews) > \"views.txt\";\n";
    ASSERT_TRUE(runs("cd " + scratch.path().string() + " && gmsh -0 m.geo"));
    EXPECT_EQ(read_text(scratch / "views.txt"), "4\n");
  }
}

}  // namespace
}  // namespace remodel
