#include "design/run_mesh.h"

namespace remodel {

LayeredMesh with_layers(const DesignSpace& space, const Mesh& outer, std::span<const double> design) {
  return space.layers()->around(outer, space.walls(design));
}

void write_run_mesh(const DesignSpace& space, const Mesh& mesh, std::span<const double> design,
                    const std::filesystem::path& file, const WriteOptions& options) {
  if (space.layers() == nullptr)
    write_mesh(mesh, file, options);
  else
    write_mesh(with_layers(space, mesh, design), file, options);
}

std::unique_ptr<EvaluatorState> restore_state(Evaluator& evaluator, const DesignSpace& space,
                                              const std::string& bytes, const Mesh& mesh,
                                              std::span<const double> design, const std::string& source) {
  if (space.layers() == nullptr) return evaluator.restore(bytes, mesh, source);
  return evaluator.restore_layered(bytes, with_layers(space, mesh, design), source);
}

}  // namespace remodel
