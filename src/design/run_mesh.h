#pragma once

// A run's mesh as others see it: with its layers, where the design space has some. What the run itself goes
// on from is the outer mesh alone.

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "remodel/design_space.h"
#include "remodel/evaluator.h"
#include "remodel/io.h"
#include "remodel/layers.h"

namespace remodel {

// Precondition: the space has layers, and the mesh is of this design.
LayeredMesh with_layers(const DesignSpace& space, const Mesh& outer, std::span<const double> design);

// The native file of a run's mesh.
void write_run_mesh(const DesignSpace& space, const Mesh& mesh, std::span<const double> design,
                    const std::filesystem::path& file, const WriteOptions& options);

std::unique_ptr<EvaluatorState> restore_state(Evaluator& evaluator, const DesignSpace& space,
                                              const std::string& bytes, const Mesh& mesh,
                                              std::span<const double> design, const std::string& source);

}  // namespace remodel
