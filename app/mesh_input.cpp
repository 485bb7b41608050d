#include "mesh_input.h"

#include "remodel/error.h"
#include "remodel/io.h"
#include "warnings.h"

namespace remodel::app {

MeshInput read_any_mesh(const std::filesystem::path& file) {
  MeshInput input;
  const KeptPipes once;
  if (holds_layers(file)) {
    input.layered = read_layered_mesh(file);
    // As it was written: all cells may be triangles.
    input.frozen = input.layered->freeze();
    if (read_frozen_mesh(file).quads.empty()) input.frozen = input.layered->freeze(LayerCells::triangles);
    input.su2_boxes = read_su2_boxes(file);
    return input;
  }
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
    input.unused_points = notes.unused_points;
    warn_of(notes);
  }
  return input;
}

void write_with_fields(const MeshOutputs& outputs, const MeshInput& input, std::span<const Field> fields) {
  if (input.layered) {
    const bool triangles = input.frozen.quads.empty();
    outputs.write(*input.layered, triangles ? LayerCells::triangles : LayerCells::quadrilaterals, fields);
  } else if (input.living) {
    outputs.write(*input.living, fields);
  } else {
    outputs.write(input.frozen, fields);
  }
}

}  // namespace remodel::app
