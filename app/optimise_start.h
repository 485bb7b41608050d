#pragma once

// Where `optimise` starts: an airfoil, around which a mesh is generated, or a mesh, whose airfoil is found.

#include <filesystem>
#include <functional>
#include <string>

#include "layer_options.h"
#include "meshing_options.h"
#include "remodel/optimise.h"
#include "shape_input.h"
#include "start_mesh.h"

namespace remodel::app {

struct OptimiseStartOptions {
  std::string from;  // one of these two
  std::string mesh;
  StartMeshOptions start;
  LayerChoice layers;
  std::function<bool(const std::string&)> given;  // whether an option is on the command line
};

// Nothing that is not a run's own may be mixed with its files or replaced by them: throws Error (file).
void require_run_directory(const std::filesystem::path& directory);

void add_optimise_start_options(CLI::App& app, OptimiseStartOptions& options);

struct OptimiseStart {
  CstAirfoil from;
  std::optional<StartMesh> file;  // of a mesh start, without its mesh
  std::vector<ShapeFit> fits;     // of coordinate files
  CstFit fit;                     // of the mesh's airfoil
  RemodelResult first;            // from the file's mesh to the fitted airfoil
};

// Reads the start and completes run.start, or run.domain and run.quality; run.layers and run.strategy where
// there are layers. Throws Error for options that do not go together.
OptimiseStart read_start(const OptimiseStartOptions& options, const MeshingOptions& meshing,
                         OptimiseOptions& run);

// The resolved meshing options: all of them, or those that a start mesh leaves open.
Json meshing_json(const MeshingOptions& meshing, const OptimiseOptions& run);
// from, or mesh, boundary, import, fit{} and start{}.
void add_start_figures(Report& report, const OptimiseStartOptions& options, const OptimiseStart& start,
                       bool layered);

}  // namespace remodel::app
