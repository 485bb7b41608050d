#pragma once

// A mesh to go on from: a native one, or another program's, imported. And which of its boundaries is changed.

#include <optional>
#include <string>

#include "remodel/import.h"
#include "remodel/mesh.h"
#include "report.h"

namespace CLI {
class App;
}

namespace remodel::app {

struct StartMeshOptions {
  std::string boundary;  // empty: the airfoil that a native mesh knows
  std::optional<int> points;
  std::optional<double> refine_angle_deg;
  double usual_refine_angle_deg = 0.0;  // where none is given: as in ImportOptions
  std::optional<double> gradation;
  std::optional<NonDelaunay> non_delaunay;
};

// --boundary, --refine-angle, --non-delaunay.
void add_start_mesh_options(CLI::App& app, StartMeshOptions& options);

struct StartMesh {
  Mesh mesh;
  std::string source;                    // the file, for messages
  std::optional<ImportResult> imported;  // without its mesh: how the import went
};

// Any readable format. Throws Error as the readers and import_mesh() do, and for options that a native mesh
// has its own of.
StartMesh read_start_mesh(const std::string& file, const StartMeshOptions& options);

// The loop that is changed. Throws Error as find_airfoil() does, and where no boundary is named and the mesh
// knows no airfoil.
AirfoilPlace place_in(const StartMesh& start, const StartMeshOptions& options);

// import{...}: how it went.
void add_import_figures(Report& report, const StartMesh& start);
// kept{triangles, min_angle_deg} and changed{...}, of imported meshes.
void add_part_figures(Report& report, const Mesh& mesh);
// The smallest angle of what is written.
double smallest_angle(const Mesh& mesh);

}  // namespace remodel::app
