// The living mesh in and out of the native file.

#include "io/formats.h"
#include "io/vtkhdf.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/layers.h"
#include "remodel/mesh_state.h"

namespace remodel {

void write_mesh(const Mesh& mesh, const std::filesystem::path& file, const WriteOptions& options) {
  if (mesh_format(file) != MeshFormat::vtkhdf) return write_mesh(mesh.freeze(), file, options);
  io::write_vtkhdf(file, mesh, options);
}

Mesh read_mesh(const std::filesystem::path& file) {
  const KeptPipes once;
  if (io::format_to_read(file) != MeshFormat::vtkhdf) {
    throw Error(ErrorCode::argument, file.string(),
                (is_pipe(file) ? "another mesh" : "'" + file.extension().string() + "'") +
                    " found, a native mesh (.vtkhdf) with its state expected, as `remodel mesh` makes it");
  }
  return Mesh::restore(io::read_vtkhdf_state(file), file.string());
}

void write_mesh(const LayeredMesh& mesh, const std::filesystem::path& file, const WriteOptions& options,
                LayerCells cells) {
  if (mesh_format(file) != MeshFormat::vtkhdf) return write_mesh(mesh.freeze(cells), file, options);
  io::write_vtkhdf(file, mesh, options, cells);
}

void write_mesh(const LayeredMesh& mesh, const std::filesystem::path& file, const WriteOptions& options) {
  write_mesh(mesh, file, options, LayerCells::quadrilaterals);
}

bool holds_layers(const std::filesystem::path& file) {
  return io::format_to_read(file) == MeshFormat::vtkhdf && io::holds_vtkhdf_layers(file);
}

LayeredMesh read_layered_mesh(const std::filesystem::path& file) {
  const KeptPipes once;
  if (io::format_to_read(file) != MeshFormat::vtkhdf) {
    throw Error(
        ErrorCode::argument, file.string(),
        "another format found, a native mesh (.vtkhdf) with layers expected, as `remodel mesh --layers` "
        "makes it");
  }
  return LayeredMesh::restore(io::read_vtkhdf_layers(file), file.string());
}

Mesh read_outer_mesh(const std::filesystem::path& file) {
  const KeptPipes once;
  return holds_layers(file) ? read_layered_mesh(file).outer() : read_mesh(file);
}

}  // namespace remodel
