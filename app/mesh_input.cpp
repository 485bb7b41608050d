#include "mesh_input.h"

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {

MeshInput read_any_mesh(const std::filesystem::path& file) {
  MeshInput input;
  try {
    input.living = read_mesh(file);
    input.frozen = input.living->freeze();
  } catch (const Error& error) {
    // Not a native mesh at all, in contrast to one that is damaged.
    if (error.code() != ErrorCode::argument) throw;
    input.frozen = read_frozen_mesh(file);
  }
  return input;
}

}  // namespace remodel::app
