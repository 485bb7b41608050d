// remodel update MESH SHAPE... [-o MESH]...: the same mesh, remodelled to another shape.

#include <algorithm>
#include <memory>
#include <optional>

#include "arguments.h"
#include "command.h"
#include "domain_input.h"
#include "figures.h"
#include "meshing_options.h"
#include "new_airfoil.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "remodel_options.h"
#include "start_mesh.h"
#include "timing.h"

namespace remodel::app {
namespace {

struct UpdateCommand {
  std::string mesh;
  StartMeshOptions start;
  DomainInputOptions shapes;
  int cst_degree = 5;
  RemodelOptions remodelling;
  MeshOutputs outputs;
  int repeat = 1;
  bool json = false;
};

void add_figures(Report& report, const RemodelResult& result) {
  report.figure("triangles_before", "triangles before", result.triangles_before);
  report.figure("triangles", "triangles", result.triangles);
  report.figure("preserved", "preserved", result.preserved, "triangles");
  report.figure("preserved_percent", "preserved", result.preserved_percent(), "%");
  report.figure("moved", "moved", result.moved, "boundary vertices");
  report.figure("inserted", "inserted", result.inserted, "vertices");
  report.figure("removed", "removed", result.removed, "vertices");
  report.figure("full_adjustment", "full adjustment", result.full_adjustment);
  report.figure("method", "method", name_of(result.method));
  report.figure("refreshed", "generated afresh by the strategy", result.refreshed);
  report.figure("regenerated", "generated afresh", result.regenerated);
  if (result.regenerated) report.figure("reason", "because", result.reason);
}

// One airfoil takes the place of the mesh's own; several, or a domain, are all that there is afterwards.
DomainInput new_domain(const StartMesh& start, const UpdateCommand& command) {
  if (is_single_airfoil(command.shapes)) {
    const CstAirfoil airfoil = load_airfoil(command.shapes.shapes[0], command.cst_degree);
    return {.domain = with_new_airfoil(start, command.start, airfoil), .findings = std::nullopt};
  }
  if (!command.start.boundary.empty())
    throw Error(ErrorCode::argument, "--boundary",
                "given with a whole domain, expected one airfoil to put there");
  AirfoilDomainOptions discretisation = discretisation_of(start.mesh.domain());
  if (command.start.points) discretisation.points = *command.start.points;
  return read_domain(command.shapes, discretisation, command.cst_degree);
}

Status run(const UpdateCommand& command) {
  command.outputs.require_possible();
  const StartMesh start = read_start_mesh(command.mesh, command.start);
  const Mesh& original = start.mesh;
  const DomainInput input = new_domain(start, command);

  Mesh mesh;
  RemodelResult result;
  std::vector<double> seconds;
  for (int i = 0; i < command.repeat; ++i) {
    mesh = original;
    const Stopwatch watch;
    result = remodel(mesh, input.domain, command.remodelling);
    seconds.push_back(watch.seconds());
  }
  command.outputs.write(mesh);

  Report report;
  report.line("mesh", command.mesh);
  for (const std::string& shape : command.shapes.shapes) report.line("shape", shape);
  add_findings(report, input);
  report.line("removal distance D", Json(command.remodelling.distance).dump());
  add_import_figures(report, start);
  add_figures(report, result);
  add_part_figures(report, mesh);
  const MeshStatistics statistics = mesh.statistics();
  report.figure("min_angle_deg", "smallest angle", smallest_angle(mesh), "degrees");
  add_exemption_figures(report, statistics.exempt_triangles, statistics.min_held_angle_deg);
  report.figure("keep", "kept triangles take up to", mesh.options().keep, "H");
  report.figure("max_gradation", "largest r / (keep H mean LS)", statistics.max_gradation);
  add_gradation_error(report, mesh.gradation_error());
  report.figure("seconds", command.repeat > 1 ? "remodelling, median" : "remodelling", median(seconds),
                "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return result.stopped == Stopped::done ? Status::done : Status::limit;
}

}  // namespace

void add_update_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<UpdateCommand>();
  CLI::App& app =
      add_subcommand(program, "update", "Remodels a mesh to another airfoil, or to another domain",
                     [command, &action] { action = [command] { return run(*command); }; });
  add_text(app, {"mesh", "MESH", "", "Mesh: a native one (.vtkhdf), or .su2, .msh, .vtu with --boundary"},
           Presence::required, command->mesh);
  add_domain_input(app, command->shapes);
  add_start_mesh_options(app, command->start);
  add_integer(app,
              {"--points", "I", "as many as in the mesh", "Vertices on the new airfoil: even, 8 to 100000"},
              {.low = 8, .high = 100000, .even = true},
              [command](std::int64_t value) { command->start.points = static_cast<int>(value); });
  command->outputs.add_options(app, Presence::optional);
  add_cst_degree(app, command->cst_degree);
  add_remodel_options(app, command->remodelling);
  add_step_strategy(app, command->remodelling);
  add_repeat(app, command->repeat);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
