#pragma once

// A mesh file of any format, with its living state where it has one.

#include <filesystem>
#include <optional>

#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"

namespace remodel::app {

struct MeshInput {
  std::optional<Mesh> living;  // of a native file with state
  FrozenMesh frozen;
};

// Throws Error as the readers of io.h do. A native file whose state is damaged is refused, not taken for one
// without state.
MeshInput read_any_mesh(const std::filesystem::path& file);

}  // namespace remodel::app
