#pragma once

// The mesh that a command starts from, native or imported from another program's file, and the boundary that
// is changed.

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
  std::optional<double> gradation;
  std::optional<NonDelaunay> non_delaunay;
  bool dissolve_layers = false;
};

// --boundary, --refine-angle, --non-delaunay, --dissolve-layers.
void add_start_mesh_options(CLI::App& app, StartMeshOptions& options);

// Behind the name of a file whose format has no place for StartMesh::su2_boxes.
inline constexpr const char* boxes_left_out = ": FFD boxes are left out, for which the format has no place";

struct StartMesh {
  Mesh mesh;
  std::string source;                    // the file, for messages
  std::optional<ImportResult> imported;  // the result of the import, without its mesh
  std::string su2_boxes = {};            // of the file, without points of its surface
};

// Reads any readable format, and warns of what is left out. Throws Error as the readers and import_mesh() do,
// and for options that a native mesh already has.
StartMesh read_start_mesh(const std::string& file, const StartMeshOptions& options);

// The loop that is changed. Throws Error as find_airfoil() does, and if no boundary is named and the mesh has
// no known airfoil.
AirfoilPlace place_in(const StartMesh& start, const StartMeshOptions& options);

// Reports the result of the import under import{...}.
void add_import_figures(Report& report, const StartMesh& start);
// Reports kept{triangles, min_angle_deg} and changed{...} of imported meshes.
void add_part_figures(Report& report, const Mesh& mesh);
// The smallest angle of the mesh as it is written.
double smallest_angle(const Mesh& mesh);

}  // namespace remodel::app
