#pragma once

// Figures and options that several subcommands share.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"
#include "report.h"

namespace CLI {
class App;
}

namespace remodel::app {

inline constexpr const char* shape_help =
    "Airfoil coordinate file (Selig, Lednicer and others, by content), naca:2412 (also 0012-64, 23112, "
    "63-206), a "
    "name that `remodel shapes` lists, or a .json file of CST coefficients";

void add_json_flag(CLI::App& app, bool& json);
void add_shape_argument(CLI::App& app, std::string& shape);
void add_mesh_argument(CLI::App& app, std::string& mesh);  // of any format

// triangles, quadrilaterals and cells, which are both.
void add_cell_counts(Report& report, std::size_t triangles, std::size_t quadrilaterals);
// triangles, vertices, boundary{name: edges}, steiner_boundary_vertices, min_angle_deg, max_radius_edge,
// max_gradation.
void add_mesh_figures(Report& report, const FrozenMesh& mesh, const MeshStatistics& statistics);
void add_gradation_error(Report& report, const GradationError& error);  // gradation_bias, gradation_deviation
// exempt_triangles and, if there are any, min_held_angle_deg of all other triangles.
void add_exemption_figures(Report& report, std::size_t exempt, double min_held_angle_deg);
void add_boundary_figures(Report& report, const std::map<std::string, std::size_t>& boundary);
// The figures of a step. `cells`: what it counts.
void add_step_figures(Report& report, const RemodelResult& result, const std::string& cells = "triangles");
void add_output_figures(Report& report, const std::vector<std::string>& files);

// What a flow was solved on: the mesh's source and size, and the model.
void add_flow_mesh(Report& report, const std::string& source, const char* model, const FrozenMesh& mesh);

}  // namespace remodel::app
