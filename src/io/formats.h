#pragma once

// One reader and one writer a text format, from and to memory; files are opened and written in one place.
// file is for messages; notes as of read_frozen_mesh().

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/io.h"

namespace remodel::io {

// By extension, or what comes through a pipe without one by its content, which is read for that.
MeshFormat format_to_read(const std::filesystem::path& file);

std::string su2_text(const FrozenMesh& mesh, const std::string& file,
                     InnerCurves inner = InnerCurves::left_out, const std::string& boxes = {});
FrozenMesh parse_su2(std::string_view text, const std::string& file, ReadNotes* notes = nullptr);

// version: 41 or 22.
std::string msh_text(const FrozenMesh& mesh, int version, const std::string& file,
                     std::span<const Field> fields = {});
FrozenMesh parse_msh(std::string_view text, const std::string& file, ReadNotes* notes = nullptr);
std::vector<Field> parse_msh_fields(std::string_view text, const std::string& file);

std::string vtu_text(const FrozenMesh& mesh, std::span<const Field> fields = {});
FrozenMesh parse_vtu(std::string_view text, const std::string& file, ReadNotes* notes = nullptr);
std::vector<Field> parse_vtu_fields(std::string_view text, const std::string& file);

}  // namespace remodel::io
