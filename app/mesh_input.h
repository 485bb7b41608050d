#pragma once

// Reads a mesh file of any format, with its living state if it has one.

#include <filesystem>
#include <optional>
#include <span>

#include "outputs.h"
#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"
#include "remodel/shape_domain.h"

namespace remodel::app {

struct MeshInput {
  std::optional<Mesh> living;           // of a native file with state
  std::optional<LayeredMesh> layered;  // of one with layers
  FrozenMesh frozen;
  std::string su2_boxes = {};  // ReadNotes::su2_boxes
  std::size_t unused_points = 0;  // ReadNotes::unused_points
  std::vector<ShapeFit> fits = {};  // of coordinate files that a fresh mesh is of
};

// Warns of what the reader left out. Throws Error as the readers of io.h do. A native file whose state is
// damaged is refused, not taken for one without state.
MeshInput read_any_mesh(const std::filesystem::path& file);

// Writes the living mesh where there is one, so that native outputs keep its state.
void write_with_fields(const MeshOutputs& outputs, const MeshInput& input, std::span<const Field> fields);

}  // namespace remodel::app
