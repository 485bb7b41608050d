#include "io/vtkhdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "io/hdf5_file.h"
#include "io/test_meshes.h"
#include "remodel/io.h"
#include "remodel/mesh_state.h"

namespace remodel {
namespace {

using io::Hdf5Reader;
using io::Hdf5Writer;
using test::error_of;
using test::Scratch;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// No mesh, but one of each kind of number; every array's values are found nowhere else in the file.
MeshState some_state() {
  MeshState state;
  state.coordinates = {1.25, -2.5, 1e-300, 4.0 / 3, 0.1, 0.2};
  state.length_scales = {1.0 / 7, 2.0 / 7, 3.0 / 7};
  state.vertex_stars = {100001, no_index, 100003};
  state.vertex_generations = {200001, 200002, 200003};
  state.vertex_curves = {-1, 300002, 300003};
  state.vertex_parameters = {0.123, 0.456, 0.789};
  state.vertex_scale_factors = {0.321, 0.654, 0.987};
  state.triangle_vertices = {400001, 400002, 400003, no_index, no_index, no_index};
  state.triangle_links = {500001, 500002, 500003, 500004, 500005, 500006};
  state.triangle_regions = {600001, 600002};
  state.triangle_births = {700001, 700002};
  state.free_vertices = {800001, 800002, 800003};
  state.free_triangles = {};
  state.step = 12345;
  state.renewal.until_renewal = 4;
  state.renewal.pending_vertices = {900001, 900002};
  state.domain.loops = {
      {LoopRole::outer, {{"wall", Polyline{{{0, 0}, {1, 0}, {0, 1.0 / 3}}}, {0, 1.0 / 3, 2.0 / 3}}}}};
  state.options.min_angle_deg = 27.5;
  state.options.max_vertices = 987654;
  return state;
}

TEST(NativeFile, GivesBackTheStateExactlyAndTheFrozenViewBesideIt) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  const MeshState state = some_state();
  io::write_vtkhdf(file, test::full_square_ring(), &state);
  EXPECT_EQ(io::read_vtkhdf_state(file), state);
  EXPECT_EQ(io::read_vtkhdf_frozen(file).triangles, test::square_ring().triangles);
}

TEST(NativeFile, TheSameStateGivesTheSameBytes) {
  const Scratch scratch;
  const MeshState state = some_state();
  io::write_vtkhdf(scratch / "a.vtkhdf", test::full_square_ring(), &state);
  io::write_vtkhdf(scratch / "b.vtkhdf", test::full_square_ring(), &state);
  EXPECT_EQ(read_text(scratch / "a.vtkhdf"), read_text(scratch / "b.vtkhdf"));
}

template <class Value>
std::string bytes_of(Value value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

TEST(NativeFile, AFlippedBitInAnyPartOfTheStateIsRefusedByTheChecksum) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  const MeshState state = some_state();
  io::write_vtkhdf(file, test::square_ring(), &state);
  const std::string whole = read_text(file);
  const std::string marks[] = {
      bytes_of(1.25),    bytes_of(2.0 / 7), bytes_of(100001U), bytes_of(200002U),
      bytes_of(300003),  bytes_of(0.456),   bytes_of(0.987),   bytes_of(400003U) + bytes_of(no_index),
      bytes_of(500006U), bytes_of(600002U), bytes_of(700001U), bytes_of(800003U),
      bytes_of(900002U), bytes_of(12345U),  bytes_of(27.5),    bytes_of(987654U),
      "\"loops\"",
  };
  for (const std::string& mark : marks) {
    const auto at = whole.find(mark);
    ASSERT_NE(at, std::string::npos);
    ASSERT_EQ(whole.find(mark, at + mark.size()), std::string::npos) << "the mark is not unique";
    for (std::size_t byte = 0; byte < mark.size(); ++byte) {
      std::string damaged = whole;
      damaged[at + byte] = static_cast<char>(damaged[at + byte] ^ 0x10);
      write_text_atomically(file, damaged);
      EXPECT_EQ(error_of([&] { io::read_vtkhdf_state(file); }),
                file.string() + ": another checksum than that of the content found: the file is damaged");
      // Changed in place by a program that leaves no seal behind: the state has a checksum of its own.
      write_text_atomically(file, damaged.substr(0, damaged.size() - 16));
      EXPECT_EQ(
          error_of([&] { io::read_vtkhdf_state(file); }),
          file.string() +
              ":/remodel@checksum: another checksum than that of the content found: the file is damaged");
    }
  }
}

TEST(NativeFile, AFileWithoutStateSaysWhatWasExpected) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  write_mesh(test::square_ring(), file);
  EXPECT_EQ(error_of([&] { io::read_vtkhdf_state(file); }),
            file.string() +
                ":/remodel: not found, a native mesh with its state expected, as `remodel mesh` makes it");
}

TEST(NativeFile, AnotherStateVersionIsNamed) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  Hdf5Writer out("m");
  out.group("/VTKHDF");
  out.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{2, 1});
  out.attribute("/VTKHDF", "Type", "UnstructuredGrid");
  out.group("/remodel");
  out.attribute("/remodel", "format_version", std::vector<std::int64_t>{9});
  write_text_atomically(file, out.bytes());
  EXPECT_EQ(error_of([&] { io::read_vtkhdf_state(file); }),
            file.string() + ":/remodel@format_version: 9 found, 6 expected");
}

// ------------------------------------------------------------------------------------- the VTKHDF layout

// A file by hand, with one thing replaced.
struct Layout {
  std::vector<std::int64_t> version = {1, 0};
  std::string type = "UnstructuredGrid";
  std::vector<std::int64_t> point_count = {3}, cell_count = {1}, connectivity_count = {3};
  std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<std::int64_t> connectivity = {0, 1, 2}, offsets = {0, 3};
  std::vector<std::uint8_t> types = {5};
  std::vector<std::int32_t> boundary = {};
};

std::string layout_problem(const Layout& layout) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  Hdf5Writer out("m");
  out.group("/VTKHDF");
  out.attribute("/VTKHDF", "Version", layout.version);
  out.attribute("/VTKHDF", "Type", layout.type);
  out.array("/VTKHDF/NumberOfPoints", layout.point_count);
  out.array("/VTKHDF/NumberOfCells", layout.cell_count);
  out.array("/VTKHDF/NumberOfConnectivityIds", layout.connectivity_count);
  out.array("/VTKHDF/Points", layout.points, 3);
  out.array("/VTKHDF/Connectivity", layout.connectivity);
  out.array("/VTKHDF/Offsets", layout.offsets);
  if (!layout.types.empty()) out.array("/VTKHDF/Types", layout.types);
  if (!layout.boundary.empty()) {
    out.group("/VTKHDF/CellData");
    out.array("/VTKHDF/CellData/boundary", layout.boundary);
  }
  write_text_atomically(file, out.bytes());
  const std::string error = error_of([&] { read_frozen_mesh(file); });
  return error.empty() ? "read" : error.substr(file.string().size());
}

TEST(VtkhdfLayout, EachProblemNamesItsDataset) {
  EXPECT_EQ(layout_problem({}), "read");
  EXPECT_EQ(layout_problem({.version = {2, 0}}), "read");
  EXPECT_EQ(layout_problem({.version = {3, 0}}), ":/VTKHDF@Version: version 3 found, 1 or 2 expected");
  EXPECT_EQ(layout_problem({.type = "ImageData"}),
            ":/VTKHDF@Type: 'ImageData' found, 'UnstructuredGrid' expected");
  EXPECT_EQ(layout_problem({.point_count = {3, 0}}),
            ":/VTKHDF/NumberOfPoints: 2 partitions found, one expected");
  EXPECT_EQ(layout_problem({.cell_count = {-1}}), ":/VTKHDF/NumberOfCells: -1 found, 1 expected");
  EXPECT_EQ(layout_problem({.connectivity = {0, 1, 3}}),
            ":/VTKHDF/Connectivity: point 3 found in cell 0, an index below 3 expected");
  EXPECT_EQ(layout_problem({.offsets = {0, 4}}),
            ":/VTKHDF/Offsets: 0 to 4 found for cell 0, 3 values of connectivity expected");
  EXPECT_EQ(layout_problem({.offsets = {0}}), ":/VTKHDF/Offsets: 1 values found, 2 expected");
  EXPECT_EQ(layout_problem({.types = {9}}),
            ":/VTKHDF/Offsets: 0 to 3 found for cell 0, 4 values of connectivity expected");
  EXPECT_TRUE(
      contains(layout_problem({.types = {22}}), "cell 0 of type 22 found, only triangles (type 5), "));
  EXPECT_EQ(layout_problem({.types = {}}), ":/VTKHDF/Types: not found, a dataset expected");
  EXPECT_EQ(layout_problem({.boundary = {0, 0}}), ":/VTKHDF/CellData/boundary: 2 values found, 1 expected");
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300}) {
    EXPECT_TRUE(contains(layout_problem({.points = {0, 0, 0, bad, 0, 0, 0, 1, 0}}), ":/VTKHDF/Points: "));
  }
}

// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html
TEST(VtkhdfLayout, HasWhatTheSpecificationAsksFor) {
  const Scratch scratch;
  write_mesh(test::full_square_ring(), scratch / "m.vtkhdf");
  const Hdf5Reader in(scratch / "m.vtkhdf");
  EXPECT_EQ(in.attribute<std::int64_t>("/VTKHDF", "Version"), (std::vector<std::int64_t>{1, 0}));
  EXPECT_EQ(in.text_attribute("/VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_EQ(in.array<std::int64_t>("/VTKHDF/NumberOfPoints"), std::vector<std::int64_t>{8});
  EXPECT_EQ(in.array<std::int64_t>("/VTKHDF/NumberOfCells"), std::vector<std::int64_t>{16});
  EXPECT_EQ(in.array<std::int64_t>("/VTKHDF/NumberOfConnectivityIds"), std::vector<std::int64_t>{40});
  EXPECT_EQ(in.array<double>("/VTKHDF/Points").size(), 24U);
  EXPECT_EQ(in.array<std::int64_t>("/VTKHDF/Offsets").back(), 40);
  EXPECT_EQ(in.array<std::uint8_t>("/VTKHDF/Types").size(), 16U);
  EXPECT_EQ(in.array<std::int32_t>("/VTKHDF/CellData/boundary").size(), 16U);
  EXPECT_EQ(in.texts("/VTKHDF/FieldData/boundary_names"), (std::vector<std::string>{"outer", "hole"}));
}

TEST(VtkhdfLayout, ADatasetThatClaimsMoreThanTheFileHoldsIsRefused) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  {
    // Declared, never written: HDF5 would invent the values.
    const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hsize_t size = hsize_t{1} << 40;
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t set = H5Dcreate2(id, "/huge", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dclose(set);
    H5Sclose(space);
    H5Fclose(id);
  }
  const Hdf5Reader in(file);
  EXPECT_TRUE(contains(error_of([&] { in.array<double>("/huge"); }),
                       "/huge: 1099511627776 values found, no more than the file can hold expected"));
}

TEST(VtkHdf, KeepsTheLastGenerationOfKeysWithoutAStateToo) {
  const Scratch scratch;
  FrozenMesh mesh = test::full_square_ring();
  mesh.last_generation = 12;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    mesh.vertex_keys.push_back((std::uint64_t{1} << 32) + v + 1);
  for (const char* name : {"m.vtkhdf", "m.vtu", "m.msh"}) {
    write_mesh(mesh, scratch / name);
    EXPECT_EQ(read_frozen_mesh(scratch / name).last_generation, 12U) << name;
  }
}

}  // namespace
}  // namespace remodel
