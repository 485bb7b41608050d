#pragma once

// Brings a mesh as another program wrote it into our conventions.

#include <cstdint>
#include <string>

#include "remodel/frozen_mesh.h"

namespace remodel::io {

// Turns clockwise triangles, turns boundary edges so that the domain is on their left, and orders the edges
// of each boundary along its loops or chains, each starting at the edge that came first. Changes nothing in a
// mesh of ours. An edge without a triangle, or between two, keeps its direction: judging the mesh is for
// check(). Indices must be in range. Throws Error (format) if there is no triangle.
void adopt_conventions(FrozenMesh& mesh, const std::string& file);

// The boundary of that name, made if it is new.
FrozenBoundary& boundary_named(FrozenMesh& mesh, const std::string& name);

}  // namespace remodel::io
