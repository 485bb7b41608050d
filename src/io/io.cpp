// Which format a file has, and what goes where.

#include "remodel/io.h"

#include "io/formats.h"
#include "io/vtkhdf.h"
#include "remodel/error.h"

namespace remodel {

MeshFormat mesh_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".vtkhdf") return MeshFormat::vtkhdf;
  if (extension == ".su2") return MeshFormat::su2;
  if (extension == ".msh") return MeshFormat::msh;
  if (extension == ".vtu") return MeshFormat::vtu;
  throw Error(ErrorCode::argument, file.string(),
              (extension.empty() ? "no extension" : "extension '" + extension + "'") +
                  " found, .vtkhdf, .su2, .msh or .vtu expected");
}

void write_mesh(const FrozenMesh& mesh, const std::filesystem::path& file, const WriteOptions& options) {
  const std::string name = file.string();
  switch (mesh_format(file)) {
    case MeshFormat::vtkhdf:
      return io::write_vtkhdf(file, mesh, nullptr);
    case MeshFormat::su2:
      return write_text_atomically(file, io::su2_text(mesh, name));
    case MeshFormat::msh:
      return write_text_atomically(file, io::msh_text(mesh, options.msh_version, name));
    case MeshFormat::vtu:
      return write_text_atomically(file, io::vtu_text(mesh));
  }
}

FrozenMesh read_frozen_mesh(const std::filesystem::path& file) {
  const std::string name = file.string();
  switch (mesh_format(file)) {
    case MeshFormat::vtkhdf:
      break;
    case MeshFormat::su2:
      return io::parse_su2(read_text(file), name);
    case MeshFormat::msh:
      return io::parse_msh(read_text(file), name);
    case MeshFormat::vtu:
      return io::parse_vtu(read_text(file), name);
  }
  return io::read_vtkhdf_frozen(file);
}

}  // namespace remodel
