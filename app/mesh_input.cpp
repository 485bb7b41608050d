#include "mesh_input.h"

#include "remodel/error.h"
#include "remodel/io.h"
#include "warnings.h"

namespace remodel::app {

MeshInput read_any_mesh(const std::filesystem::path& file) {
  MeshInput input;
  const KeptPipes once;
  try {
    input.living = read_mesh(file);
    input.frozen = input.living->freeze();
    input.su2_boxes = read_su2_boxes(file);
  } catch (const Error& error) {
    // The file is not a native mesh, as opposed to a damaged one.
    if (error.code() != ErrorCode::argument) throw;
    ReadNotes notes;
    input.frozen = read_frozen_mesh(file, &notes);
    input.su2_boxes = std::move(notes.su2_boxes);
    warn_of(notes);
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
