// Native files: the frozen view and the living mesh. HDF5 itself is not instrumented.

#include <unistd.h>

#include <fstream>

#include "fuzz.h"
#include "remodel/io.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("remodel-fuzz-" + std::to_string(::getpid()) + ".vtkhdf");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const FrozenMesh mesh = read_frozen_mesh(file);
    if (mesh.triangles.size() <= 64) check(mesh);
  } catch (const Error&) {
  }
  try {
    read_mesh(file).quick_check();
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  std::filesystem::remove(file);
  return 0;
}
