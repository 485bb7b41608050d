// SU2 meshes.

#include "fuzz.h"
#include "io/formats.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const FrozenMesh mesh = io::parse_su2(fuzz::text_of(data, size), "input");
    fuzz::use(mesh, [](const FrozenMesh& m) { return io::parse_su2(io::su2_text(m, "again"), "again"); });
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  return 0;
}
