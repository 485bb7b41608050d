// Well-formed HDF5 files that are no mesh: a native file with values, sizes, kinds and names of its datasets
// and attributes changed through HDF5, as another program could write it, without a seal.

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "fuzz.h"
#include "remodel/generate.h"
#include "remodel/io.h"

using namespace remodel;

namespace {

// A temporary directory that is removed when the process ends.
class Scratch {
 public:
  Scratch() { std::filesystem::create_directories(path_); }
  ~Scratch() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("remodel-fuzz-values-" + std::to_string(::getpid()));
};
const Scratch scratch;

Mesh small_mesh() {
  const Polyline square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}};
  return generate({{{LoopRole::outer, {{"wall", square, {0, 0.25, 0.5, 0.75}}}}}}, {.gradation = 4.0}).mesh;
}

const std::string& original(bool living) {
  static const auto text = [](bool with_state) {
    const auto file = scratch / "original.vtkhdf";
    if (with_state)
      write_mesh(small_mesh(), file);
    else
      write_mesh(small_mesh().freeze(), file);
    return read_text(file);
  };
  static const std::string frozen_text = text(false), living_text = text(true);
  return living ? living_text : frozen_text;
}

herr_t add_name(hid_t, const char* name, const H5O_info_t*, void* names) {
  if (std::string_view(name) != ".") static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}
herr_t add_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

class Edits {
 public:
  Edits(hid_t file, fuzz::Bytes& bytes) : file_(file), bytes_(bytes) {}

  void one() {
    std::vector<std::string> names;
    H5Ovisit(file_, H5_INDEX_NAME, H5_ITER_INC, add_name, &names);
    if (names.empty()) return;
    const std::string name = names[bytes_.below(static_cast<unsigned>(names.size()))];
    const hid_t object = H5Oopen(file_, name.c_str(), H5P_DEFAULT);
    const bool dataset = H5Iget_type(object) == H5I_DATASET;
    switch (bytes_.below(8)) {
      case 0:
        H5Oclose(object);
        H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
        return;
      case 1:
        change_attribute(object);
        break;
      case 2:
      case 3:
        if (dataset) {
          H5Oclose(object);
          H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
          create(name);
          return;
        }
        break;
      default:
        if (dataset) change_value(object);
    }
    H5Oclose(object);
  }

 private:
  void change_value(hid_t dataset) {
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const std::size_t size = H5Tget_size(type);
    if (count > 0 && count < 100000 && !H5Tis_variable_str(type)) {
      std::vector<unsigned char> values(static_cast<std::size_t>(count) * size);
      H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      change(values, size);
      H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
    H5Sclose(space);
    H5Tclose(type);
  }

  void change_attribute(hid_t object) {
    std::vector<std::string> names;
    H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_attribute, &names);
    if (names.empty()) return;
    const std::string name = names[bytes_.below(static_cast<unsigned>(names.size()))];
    if (bytes_.below(4) == 0) {
      H5Adelete(object, name.c_str());
      return;
    }
    const hid_t attribute = H5Aopen(object, name.c_str(), H5P_DEFAULT), type = H5Aget_type(attribute),
                space = H5Aget_space(attribute);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const std::size_t size = H5Tget_size(type);
    if (count > 0 && count < 100000 && !H5Tis_variable_str(type)) {
      std::vector<unsigned char> values(static_cast<std::size_t>(count) * size);
      H5Aread(attribute, type, values.data());
      change(values, size);
      H5Awrite(attribute, type, values.data());
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(attribute);
  }

  // Changes the value of one element.
  void change(std::vector<unsigned char>& values, std::size_t size) {
    const std::size_t first = bytes_.below(static_cast<unsigned>(values.size() / size)) * size;
    switch (bytes_.below(4)) {
      case 0:
        for (std::size_t i = 0; i < size; ++i) values[first + i] = static_cast<unsigned char>(bytes_.next());
        break;
      case 1:
        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(first), size,
                    static_cast<unsigned char>(bytes_.below(2) == 0 ? 0 : 255));
        break;
      case 2:
        values[first] = static_cast<unsigned char>(values[first] + 1 + bytes_.below(3));
        break;
      case 3:
        values[first + bytes_.below(static_cast<unsigned>(size))] ^=
            static_cast<unsigned char>(1U << bytes_.below(8));
        break;
    }
  }

  // Replaces a dataset by one of another type, rank or size, perhaps without values.
  void create(const std::string& name) {
    const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I64LE,
                           H5T_STD_U32LE,  H5T_STD_U8LE,   H5T_STD_I32BE};
    const hid_t type = types[bytes_.below(6)];
    const int rank = static_cast<int>(bytes_.below(4));
    hsize_t sizes[3], chunk[3];
    for (int i = 0; i < 3; ++i) {
      const unsigned what = bytes_.below(8);
      sizes[i] = what == 0 ? 0 : what == 1 ? hsize_t{1} << (20 + bytes_.below(20)) : 1 + bytes_.below(20);
      chunk[i] = std::clamp<hsize_t>(sizes[i], 1, 64);
    }
    const hid_t space = H5Screate_simple(rank, sizes, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
    if (rank > 0) H5Pset_chunk(how, rank, chunk);
    const hid_t dataset = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    if (dataset >= 0) H5Dclose(dataset);
    H5Pclose(how);
    H5Sclose(space);
  }

  hid_t file_;
  fuzz::Bytes& bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const std::string& text = original(bytes.below(2) == 0);
  const std::filesystem::path file = scratch / "changed.vtkhdf";
  std::ofstream(file, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()) - 16);
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  fuzz::require(opened >= 0, "the original cannot be opened");
  for (int edits = 0; edits < 4 && !bytes.empty(); ++edits) Edits(opened, bytes).one();
  H5Fclose(opened);
  try {
    const FrozenMesh mesh = read_frozen_mesh(file);
    if (mesh.triangles.size() <= 1000) check(mesh);
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  try {
    read_mesh(file).quick_check();
  } catch (const Error&) {
  }
  return 0;
}
