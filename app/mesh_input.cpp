#include "mesh_input.h"

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {

MeshInput read_any_mesh(const std::filesystem::path& file) {
  MeshInput input;
  if (mesh_format(file) == MeshFormat::vtkhdf) {
    try {
      input.living = read_mesh(file);
      input.frozen = input.living->freeze();
      return input;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::format) throw;
      // Only what a living mesh wrote carries curve parameters: their presence means that the state is
      // damaged.
      input.frozen = read_frozen_mesh(file);
      if (!input.frozen.parameter.empty()) throw;
      return input;
    }
  }
  input.frozen = read_frozen_mesh(file);
  return input;
}

}  // namespace remodel::app
