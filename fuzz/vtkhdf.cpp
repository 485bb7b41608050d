// Native files: the frozen view and the living mesh. The seal at the end of a file detects damage; without it
// a damaged file reaches HDF5, which reads freed memory for some. So every input of this target has a seal;
// those of vtkhdf_values have none.

#include <unistd.h>

#include <fstream>

#include "fuzz.h"
#include "remodel/io.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t seal = 16;
  std::string bytes(fuzz::text_of(data, size));
  if (size < seal || bytes.compare(size - seal, 8, "rmdlseal") != 0) bytes += "rmdlseal01234567";
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("remodel-fuzz-" + std::to_string(::getpid()) + ".vtkhdf");
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    const FrozenMesh mesh = read_frozen_mesh(file);
    if (mesh.cell_count() <= 64) check(mesh);
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  try {
    read_mesh(file).quick_check();
  } catch (const Error&) {
  }
  try {
    read_fields(file);
  } catch (const Error&) {
  }
  std::filesystem::remove(file);
  return 0;
}
