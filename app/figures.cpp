#include "figures.h"

#include <cmath>

#include "arguments.h"

namespace remodel::app {

void add_json_flag(CLI::App& app, bool& json) {
  add_flag(app, "--json", "Print one JSON object on standard output, everything else on standard error",
           json);
}

void add_shape_argument(CLI::App& app, std::string& shape) {
  add_text(app, {"shape", "SHAPE", "", shape_help}, Presence::required, shape);
}

void add_mesh_argument(CLI::App& app, std::string& mesh) {
  add_text(app, {"mesh", "MESH", "", "Mesh file: .vtkhdf, .su2, .msh or .vtu"}, Presence::required, mesh);
}

void add_boundary_figures(Report& report, const std::map<std::string, std::size_t>& boundary) {
  Json edges = Json::object();
  // Behind the others, without a look at them: there may be a hundred thousand.
  auto& entries = static_cast<Json::object_t::Container&>(edges.get_ref<Json::object_t&>());
  for (const auto& [name, count] : boundary) {
    entries.emplace_back(name, count);
    report.line("boundary " + name, std::to_string(count) + " edges");
  }
  report.data("boundary", edges);
}

void add_exemption_figures(Report& report, std::size_t exempt, double min_held_angle_deg) {
  if (exempt > 0)
    report.figure("min_held_angle_deg", "smallest angle but for exempt triangles", min_held_angle_deg,
                  "degrees");
  report.figure("exempt_triangles", "exempt triangles", exempt, "(at input angles below 60 degrees)");
}

void add_cell_counts(Report& report, std::size_t triangles, std::size_t quadrilaterals) {
  report.figure("triangles", "triangles", triangles);
  report.data("quadrilaterals", quadrilaterals);
  if (quadrilaterals > 0) report.line("quadrilaterals", std::to_string(quadrilaterals));
  report.data("cells", triangles + quadrilaterals);
}

void add_mesh_figures(Report& report, const FrozenMesh& mesh, const MeshStatistics& statistics) {
  report.figure("triangles", "triangles", statistics.triangles);
  report.figure("vertices", "vertices", statistics.vertices);
  std::map<std::string, std::size_t> boundary;
  for (const FrozenBoundary& part : mesh.boundaries) boundary[part.name] += part.edges.size();
  add_boundary_figures(report, boundary);
  report.figure("steiner_boundary_vertices", "Steiner vertices on the boundary",
                statistics.steiner_boundary_vertices);
  report.figure("min_angle_deg", "smallest angle", statistics.min_angle_deg, "degrees");
  add_exemption_figures(report, statistics.exempt_triangles, statistics.min_held_angle_deg);
  report.figure("max_radius_edge", "largest radius-edge ratio", statistics.max_radius_edge);
  report.figure("max_gradation", "largest r / (H mean LS)", statistics.max_gradation);
}

void add_gradation_error(Report& report, const GradationError& error) {
  if (std::isnan(error.bias)) {  // there was no time for it
    report.data("gradation_bias", nullptr);
    report.data("gradation_deviation", nullptr);
    return;
  }
  report.figure("gradation_bias", "gradation error, bias", error.bias);
  report.figure("gradation_deviation", "gradation error, deviation", error.deviation);
}

void add_step_figures(Report& report, const RemodelResult& result, const std::string& cells) {
  report.figure(cells + "_before", cells + " before", result.triangles_before);
  report.figure(cells, cells, result.triangles);
  report.figure("preserved", "preserved", result.preserved, cells);
  report.figure("preserved_percent", "preserved, share", result.preserved_percent(), "%");
  report.figure("connected", "joined as before", result.connected, cells);
  report.figure("connectivity_percent", "joined as before, share", result.connectivity_percent(), "%");
  report.figure("born", "born", result.born(), cells);
  report.figure("gone", "gone", result.gone(), cells);
  report.figure("flipped", "flipped", result.flipped, "edges");
  report.figure("moved", "moved", result.moved, result.morphed ? "vertices" : "boundary vertices");
  report.figure("inserted", "inserted", result.inserted, "vertices");
  report.figure("removed", "removed", result.removed, "vertices");
  report.figure("full_adjustment", "full adjustment", result.full_adjustment);
  report.figure("morphed", "morphed", result.morphed);
  report.figure("held", "a morph of its reference", result.held);
  report.figure("method", "method", name_of(result.method));
  report.figure("refreshed", "generated afresh by the strategy", result.refreshed);
  report.figure("regenerated", "generated afresh", result.regenerated);
  if (result.abandoned) report.figure("abandoned", "given up, the mesh is as it was", result.abandoned);
  if (result.reason.empty())
    report.data("reason", result.reason);
  else
    report.figure("reason", "because", result.reason);
}

void add_output_figures(Report& report, const std::vector<std::string>& files) {
  report.data("written", files);
  for (const std::string& file : files) report.line("written", file);
}

void add_flow_mesh(Report& report, const std::string& source, const char* model, const FrozenMesh& mesh) {
  report.figure("mesh", "mesh", source);
  report.data("model", model);
  add_cell_counts(report, mesh.triangles.size(), mesh.quads.size());
  report.figure("vertices", "vertices", mesh.points.size());
}

}  // namespace remodel::app
