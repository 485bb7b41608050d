// The format of a file, and the readers and writers of each.

#include "remodel/io.h"

#include <algorithm>
#include <optional>

#include "io/formats.h"
#include "io/vtkhdf.h"
#include "remodel/error.h"
#include "remodel/foam.h"

namespace remodel {

namespace {

std::optional<MeshFormat> known_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".vtkhdf") return MeshFormat::vtkhdf;
  if (extension == ".su2") return MeshFormat::su2;
  if (extension == ".msh") return MeshFormat::msh;
  if (extension == ".vtu") return MeshFormat::vtu;
  if (extension == ".foam") return MeshFormat::foam;
  return std::nullopt;
}

// SU2's comments and keywords may be anything: that is what a text is which is none of the others.
MeshFormat format_of_content(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with("\x89HDF")) return MeshFormat::vtkhdf;
  if (text.starts_with("$")) return MeshFormat::msh;
  if (text.starts_with("<")) return MeshFormat::vtu;
  return MeshFormat::su2;
}

void refuse_fields(const WriteOptions& options, const std::string& name, const std::string& extension) {
  if (!options.fields.empty())
    throw Error(
        ErrorCode::argument, name,
        "fields found, a .vtkhdf, .vtu or .msh file expected: " + extension + " has no place for them");
}

}  // namespace

MeshFormat io::format_to_read(const std::filesystem::path& file) {
  if (const auto known = known_format(file)) {
    if (*known == MeshFormat::foam)
      throw Error(ErrorCode::argument, file.string(),
                  "an OpenFOAM case found, which is written alone; .vtkhdf, .su2, .msh or .vtu expected");
    return *known;
  }
  return is_pipe(file) ? format_of_content(read_text(file)) : mesh_format(file);
}

MeshFormat mesh_format(const std::filesystem::path& file) {
  if (const auto known = known_format(file)) return *known;
  const std::string extension = file.extension().string();
  throw Error(ErrorCode::argument, file.string(),
              (extension.empty() ? "no extension" : "extension '" + extension + "'") +
                  " found, .vtkhdf, .su2, .msh, .vtu or .foam expected");
}

void write_mesh(const FrozenMesh& mesh, const std::filesystem::path& file, const WriteOptions& options) {
  const std::string name = file.string();
  switch (mesh_format(file)) {
    case MeshFormat::vtkhdf:
      return io::write_vtkhdf(file, mesh, nullptr, options);
    case MeshFormat::su2:
      refuse_fields(options, name, ".su2");
      return write_text_atomically(file, io::su2_text(mesh, name, options.inner, options.su2_boxes));
    case MeshFormat::msh:
      return write_text_atomically(file, io::msh_text(mesh, options.msh_version, name, options.fields));
    case MeshFormat::vtu:
      return write_text_atomically(file, io::vtu_text(mesh, options.fields));
    case MeshFormat::foam:
      refuse_fields(options, name, ".foam");
      return write_foam_mesh(mesh, file);
  }
}

FrozenMesh read_frozen_mesh(const std::filesystem::path& file, ReadNotes* notes) {
  const std::string name = file.string();
  const KeptPipes once;
  switch (io::format_to_read(file)) {
    case MeshFormat::vtkhdf:
    case MeshFormat::foam:
      break;
    case MeshFormat::su2:
      return io::parse_su2(read_text(file), name, notes);
    case MeshFormat::msh:
      return io::parse_msh(read_text(file), name, notes);
    case MeshFormat::vtu:
      return io::parse_vtu(read_text(file), name, notes);
  }
  return io::read_vtkhdf_frozen(file, notes);
}

std::vector<Field> read_fields(const std::filesystem::path& file) {
  const std::string name = file.string();
  const KeptPipes once;
  switch (io::format_to_read(file)) {
    case MeshFormat::vtkhdf:
    case MeshFormat::foam:
      break;
    case MeshFormat::su2:
      read_text(file);  // which has none, but has to be there
      return {};
    case MeshFormat::msh:
      return io::parse_msh_fields(read_text(file), name);
    case MeshFormat::vtu:
      return io::parse_vtu_fields(read_text(file), name);
  }
  return io::read_vtkhdf_fields(file);
}

}  // namespace remodel
