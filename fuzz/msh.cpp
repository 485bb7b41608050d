// Gmsh meshes, versions 2.2 and 4.1.

#include "fuzz.h"
#include "io/formats.h"

using namespace remodel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const FrozenMesh mesh = io::parse_msh(fuzz::text_of(data, size), "input");
    fuzz::use(mesh, [](const FrozenMesh& m) { return io::parse_msh(io::msh_text(m, 41, "again"), "again"); });
  } catch (const Error&) {
    ++fuzz::refusals;
  }
  try {
    io::parse_msh_fields(fuzz::text_of(data, size), "input");
  } catch (const Error&) {
  }
  return 0;
}
