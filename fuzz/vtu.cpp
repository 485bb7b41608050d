// VTK XML meshes.

#include "fuzz.h"
#include "io/formats.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const FrozenMesh mesh = io::parse_vtu(fuzz::text_of(data, size), "input");
    fuzz::use(mesh, [](const FrozenMesh& m) { return io::parse_vtu(io::vtu_text(m), "again"); });
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  try {
    io::parse_vtu_fields(fuzz::text_of(data, size), "input");
  } catch (const Error&) {
  }
  return 0;
}
