// How a foreign .vtkhdf may store its values: whole or in pieces, compressed or not, but in the file itself,
// and without growing out of all proportion.

#include <gtest/gtest.h>
#include <hdf5.h>
#include <zlib.h>

#include <functional>
#include <numeric>

#include "io/hdf5_file.h"
#include "io/test_meshes.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using io::Hdf5Handle;
using io::Hdf5Reader;
using io::Hdf5Writer;
using test::error_of;
using test::Scratch;

// A mesh of one triangle but for one dataset or group, which `replace` makes.
void write_triangle_without(const std::filesystem::path& file, const std::string& left_out,
                            const std::function<void(hid_t)>& replace) {
  Hdf5Writer out("m");
  const auto array = [&](const std::string& path, const auto& values, std::size_t columns = 1) {
    if (path != left_out) out.array(path, values, columns);
  };
  if (left_out != "/VTKHDF") {
    out.group("/VTKHDF");
    out.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    out.attribute("/VTKHDF", "Type", "UnstructuredGrid");
    array("/VTKHDF/NumberOfPoints", std::vector<std::int64_t>{3});
    array("/VTKHDF/NumberOfCells", std::vector<std::int64_t>{1});
    array("/VTKHDF/NumberOfConnectivityIds", std::vector<std::int64_t>{3});
    array("/VTKHDF/Points", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    array("/VTKHDF/Connectivity", std::vector<std::int64_t>{0, 1, 2});
    array("/VTKHDF/Offsets", std::vector<std::int64_t>{0, 3});
    array("/VTKHDF/Types", std::vector<std::uint8_t>{5});
  }
  write_text_atomically(file, out.bytes());
  const Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  replace(opened.get());
}

std::string problem_without(const std::string& left_out, const std::function<void(hid_t)>& replace) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  write_triangle_without(scratch / "other.vtkhdf", "", [](hid_t) {});
  std::filesystem::current_path(scratch.path());  // where the names of other files lead
  write_triangle_without(file, left_out, replace);
  const std::string error = error_of([&] { read_frozen_mesh(file); });
  std::filesystem::current_path("/");
  return error.empty() ? "read" : error.substr(file.string().size());
}

Hdf5Handle new_dataset(hid_t file, const char* path, hid_t type, std::vector<hsize_t> size,
                       const Hdf5Handle& creation) {
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  return {H5Dcreate2(file, path, type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Dclose};
}

Hdf5Handle creation_properties() {
  return {H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
}

// ------------------------------------------------------------------------------------------ other files

TEST(VtkhdfStorage, LinksToOtherPlacesAreRefused) {
  const auto soft = [](hid_t file) {
    H5Lcreate_soft("/VTKHDF/Connectivity", file, "/VTKHDF/Offsets", H5P_DEFAULT, H5P_DEFAULT);
  };
  EXPECT_EQ(problem_without("/VTKHDF/Offsets", soft),
            ":/VTKHDF/Offsets: a link to another place found, data in the file itself expected");
  for (const std::string path : {"/VTKHDF", "/VTKHDF/Points", "/VTKHDF/Types"}) {
    const auto external = [&](hid_t file) {
      H5Lcreate_external("other.vtkhdf", path.c_str(), file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    };
    EXPECT_EQ(problem_without(path, external),
              ":" + path + ": a link to another place found, data in the file itself expected");
  }
}

TEST(VtkhdfStorage, ValuesInAnotherFileAreRefused) {
  const auto raw = [](hid_t file) {
    write_text_atomically("secret", std::string(72, '\x3f'));
    const Hdf5Handle creation = creation_properties();
    H5Pset_external(creation.get(), "secret", 0, 72);
    new_dataset(file, "/VTKHDF/Points", H5T_IEEE_F64LE, {3, 3}, creation);
  };
  EXPECT_EQ(problem_without("/VTKHDF/Points", raw),
            ":/VTKHDF/Points: values in another file found, values in the file itself expected");
  const auto virtually = [](hid_t file) {
    const hsize_t size[] = {3, 3};
    const Hdf5Handle space(H5Screate_simple(2, size, nullptr), H5Sclose);
    const Hdf5Handle creation = creation_properties();
    H5Pset_virtual(creation.get(), space.get(), "other.vtkhdf", "/VTKHDF/Points", space.get());
    new_dataset(file, "/VTKHDF/Points", H5T_IEEE_F64LE, {3, 3}, creation);
  };
  EXPECT_EQ(problem_without("/VTKHDF/Points", virtually),
            ":/VTKHDF/Points: a virtual dataset found, values in the file itself expected");
}

// ---------------------------------------------------------------------------------------------- filters

TEST(VtkhdfStorage, FiltersThatNeedAPluginOrStandTwiceAreRefused) {
  const auto filtered = [](std::vector<H5Z_filter_t> filters) {
    return [filters](hid_t file) {
      const Hdf5Handle creation = creation_properties();
      const hsize_t piece = 3;
      H5Pset_chunk(creation.get(), 1, &piece);
      const unsigned level = 6;
      for (const auto filter : filters)
        H5Pset_filter(creation.get(), filter, H5Z_FLAG_OPTIONAL, filter == H5Z_FILTER_DEFLATE ? 1 : 0,
                      &level);
      const Hdf5Handle set = new_dataset(file, "/VTKHDF/Connectivity", H5T_STD_I64LE, {3}, creation);
      const std::int64_t values[] = {0, 1, 2};
      H5Dwrite(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    };
  };
  EXPECT_EQ(problem_without("/VTKHDF/Connectivity", filtered({H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE})),
            "read");
  EXPECT_EQ(problem_without("/VTKHDF/Connectivity", filtered({32000})),
            ":/VTKHDF/Connectivity: filter 32000 found, deflate or shuffle expected");
  EXPECT_EQ(problem_without("/VTKHDF/Connectivity", filtered({H5Z_FILTER_DEFLATE, H5Z_FILTER_DEFLATE})),
            ":/VTKHDF/Connectivity: filter 1 found twice, each filter once expected");
}

// `bytes` of one value as one compressed piece of a dataset that says it has `count` bytes.
auto constant_piece(std::size_t bytes, hsize_t count) {
  return [bytes, count](hid_t file) {
    const Hdf5Handle creation = creation_properties();
    H5Pset_chunk(creation.get(), 1, &count);
    H5Pset_deflate(creation.get(), 9);
    const Hdf5Handle set = new_dataset(file, "/VTKHDF/Types", H5T_STD_U8LE, {count}, creation);
    const std::string values(bytes, '\5');
    std::string packed(compressBound(values.size()), '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(values.data()),
             values.size());
    const hsize_t offset = 0;
    H5Dwrite_chunk(set.get(), H5P_DEFAULT, 0, &offset, size, packed.data());
  };
}

TEST(VtkhdfStorage, APieceThatGrowsBeyondItsSizeIsRefused) {
  EXPECT_EQ(problem_without("/VTKHDF/Types", constant_piece(1, 1)), "read");
  EXPECT_EQ(problem_without("/VTKHDF/Types", constant_piece(2, 1)),
            ":/VTKHDF/Types: damaged data or more than the file can hold found");
  EXPECT_EQ(problem_without("/VTKHDF/Types", constant_piece(50'000'000, 1)),
            ":/VTKHDF/Types: damaged data or more than the file can hold found");
}

TEST(VtkhdfStorage, AFileThatGrowsAThousandfoldIsRefusedBeforeItIsRead) {
  EXPECT_EQ(problem_without("/VTKHDF/Types", constant_piece(100'000'000, 100'000'000)),
            ":/VTKHDF/Types: 100000000 values found, no more than the file can hold expected");
}

TEST(VtkhdfStorage, APieceThatIsMissingIsNotInvented) {
  const auto empty = [](hid_t file) {
    const Hdf5Handle creation = creation_properties();
    const hsize_t piece = 1;
    H5Pset_chunk(creation.get(), 1, &piece);
    new_dataset(file, "/VTKHDF/Types", H5T_STD_U8LE, {1}, creation);
  };
  EXPECT_EQ(problem_without("/VTKHDF/Types", empty),
            ":/VTKHDF/Types: damaged data or more than the file can hold found");
}

// Any number of texts may be one and the same in the file; each is copied.
TEST(VtkhdfStorage, OneLongTextForManyIsRefused) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  constexpr std::size_t count = 3000;
  std::vector<std::string> texts(count, "x");
  texts[0] = std::string(60'000, 'y');
  Hdf5Writer out("m");
  out.texts("/texts", texts);
  std::string bytes(out.bytes());
  // A reference is the length, the heap's address and the place in the heap: 16 bytes.
  const std::string length = std::string("\x60\xea\0\0", 4);
  const std::size_t first = bytes.find(length);
  ASSERT_NE(first, std::string::npos);
  const std::string reference = bytes.substr(first, 16);
  for (std::size_t i = 1; i < count; ++i) bytes.replace(first + 16 * i, 16, reference);
  write_text_atomically(file, bytes);
  const Hdf5Reader in(file);
  EXPECT_EQ(error_of([&] { in.texts("/texts"); }),
            file.string() + ":/texts: damaged data or more than the file can hold found");
}

// ----------------------------------------------------------------------------- what other programs write

// The same values in pieces of any size, of another width and byte order, shuffled and compressed.
TEST(VtkhdfStorage, PiecesOfAnySizeGiveTheValues) {
  const Scratch scratch;
  std::vector<double> values(7 * 3);
  std::iota(values.begin(), values.end(), -5.0);
  for (const hsize_t rows : {1, 2, 7, 100}) {
    for (const hsize_t columns : {1, 2, 3}) {
      for (const bool packed : {false, true}) {
        for (const hid_t type : {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE}) {
          const auto name = scratch / "m.h5";
          {
            const Hdf5Handle file(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
            const Hdf5Handle creation = creation_properties();
            const hsize_t piece[] = {rows, columns};
            // Larger than the dataset is larger than it may be only in a dataset that can grow.
            const hsize_t size[] = {7, 3}, most[] = {H5S_UNLIMITED, 3};
            const Hdf5Handle space(H5Screate_simple(2, size, most), H5Sclose);
            H5Pset_chunk(creation.get(), 2, piece);
            if (packed) H5Pset_shuffle(creation.get());
            if (packed) H5Pset_deflate(creation.get(), 5);
            const Hdf5Handle set(H5Dcreate2(file.get(), "/values", type, space.get(), H5P_DEFAULT,
                                            creation.get(), H5P_DEFAULT),
                                 H5Dclose);
            H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
          }
          EXPECT_EQ(Hdf5Reader(name).array<double>("/values"), values)
              << rows << ' ' << columns << ' ' << packed;
        }
      }
    }
  }
}

TEST(VtkhdfStorage, TextsOfAnyLengthMayBeInPackedPiecesToo) {
  const Scratch scratch;
  const auto name = scratch / "m.h5";
  {
    const Hdf5Handle file(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const Hdf5Handle creation = creation_properties();
    const hsize_t piece = 2;
    H5Pset_chunk(creation.get(), 1, &piece);
    H5Pset_deflate(creation.get(), 9);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), H5T_VARIABLE);
    const Hdf5Handle set = new_dataset(file.get(), "/texts", type.get(), {4}, creation);
    const char* texts[] = {"outer", "", "hole", "a wall"};
    H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts);
  }
  EXPECT_EQ(Hdf5Reader(name).texts("/texts"), (std::vector<std::string>{"outer", "", "hole", "a wall"}));
}

}  // namespace
}  // namespace remodel
