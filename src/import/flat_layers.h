#pragma once

// Layers of flat cells on a wall, which a remodelling would dissolve.

#include <string>

#include "remodel/frozen_mesh.h"

namespace remodel {

// Throws Error (geometry) naming `source` as ImportOptions::layers says.
void refuse_flat_layers(const FrozenMesh& mesh, const std::string& source);

// The mesh of triangles, its quadrilaterals split. Throws Error (geometry) naming `source` for one with a
// point that is not there.
FrozenMesh without_quads(const FrozenMesh& mesh, const std::string& source);

}  // namespace remodel
