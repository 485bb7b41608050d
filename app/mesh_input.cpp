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
    // The file is not a native mesh, as opposed to a damaged one.
    if (error.code() != ErrorCode::argument) throw;
    input.frozen = read_frozen_mesh(file);
  }
  return input;
}

void write_with_fields(const MeshOutputs& outputs, const MeshInput& input, std::span<const Field> fields) {
  if (input.living) {
    outputs.write(*input.living, fields);
  } else {
    outputs.write(input.frozen, fields);
  }
}

}  // namespace remodel::app
