#pragma once

// One reader and one writer a text format, from and to memory; files are opened and written in one place.
// file is for messages.

#include <string>
#include <string_view>

#include "remodel/frozen_mesh.h"

namespace remodel::io {

std::string su2_text(const FrozenMesh& mesh, const std::string& file);
FrozenMesh parse_su2(std::string_view text, const std::string& file);

// version: 41 or 22.
std::string msh_text(const FrozenMesh& mesh, int version, const std::string& file);
FrozenMesh parse_msh(std::string_view text, const std::string& file);

std::string vtu_text(const FrozenMesh& mesh);
FrozenMesh parse_vtu(std::string_view text, const std::string& file);

}  // namespace remodel::io
