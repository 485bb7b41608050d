#pragma once

// A living mesh as bytes, for messages between processes of one program on machines of one kind: the mesh
// that is made of them goes on to the same bytes.

#include <string>

#include "remodel/mesh.h"

namespace remodel::io {

std::string mesh_to_bytes(const Mesh& mesh);
// Throws Error (format) naming `source`.
Mesh mesh_from_bytes(const std::string& bytes, const std::string& source);

}  // namespace remodel::io
