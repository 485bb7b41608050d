// remodel update MESH SHAPE... [-o MESH]...: the same mesh, remodelled to another shape.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "arguments.h"
#include "carry.h"
#include "command.h"
#include "domain_input.h"
#include "figures.h"
#include "interrupt.h"
#include "layer_options.h"
#include "layered_update.h"
#include "mesh_input.h"
#include "meshing_options.h"
#include "new_airfoil.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "remodel_options.h"
#include "shape_input.h"
#include "start_mesh.h"
#include "timing.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct UpdateCommand : LayeredUpdate {  // and what meshes without layers have beside it
  std::string reference;                // empty: the mesh itself
  StartMeshOptions start;
  bool no_regenerate = false;
  std::function<bool(const std::string&)> given;  // on the command line
};

// Triangles of the file that the new mesh has too, by the places of their corners: what import exchanges for
// Delaunay triangles is lost as well as what the step replaces.
std::size_t triangles_in_common(const FrozenMesh& file, const FrozenMesh& after) {
  const auto sorted_triangles = [](const FrozenMesh& mesh) {
    using Place = std::pair<double, double>;
    std::vector<std::array<Place, 3>> triangles;
    for (const auto& triangle : mesh.triangles) {
      std::array<Place, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point p = mesh.points[triangle[k]];
        corners[k] = {p.x, p.y};
      }
      std::sort(corners.begin(), corners.end());
      triangles.push_back(corners);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  const auto of_file = sorted_triangles(with_split_quads(file)), now = sorted_triangles(after);
  std::size_t common = 0;
  for (const auto& triangle : of_file) common += std::binary_search(now.begin(), now.end(), triangle);
  return common;
}

// Triangles that are lost are what a solver pays for: nobody should find out from its run time.
void warn_of_losses(const UpdateCommand& command, const StartMesh& start, const FrozenMesh& file,
                    const FrozenMesh& after, const RemodelResult& result) {
  const auto of = [](std::size_t part, std::size_t all) {
    return std::to_string(part) + " of " + std::to_string(all);
  };
  const auto say = [&](const std::string& message) {
    std::fprintf(stderr, "remodel: %s: %s\n", command.mesh.c_str(), message.c_str());
  };
  const std::string lost = of(result.triangles_before - result.preserved, result.triangles_before) +
                           " triangles were not preserved";
  if (result.abandoned)
    return say("cannot be completed without generating the mesh afresh: " + result.reason +
               "; nothing was written");
  if (result.regenerated) return say("generated afresh, " + lost + ": " + result.reason);
  if (2 * result.preserved < result.triangles_before)
    return say(!result.morphed
                   ? lost
                   : lost + ", as their vertices moved; " + of(result.connected, result.triangles_before) +
                         " join the same vertices as before");
  if (!start.imported || start.imported->flipped_edges == 0) return;
  const std::size_t common = triangles_in_common(file, after);
  const std::size_t all = file.triangles.size() + 2 * file.quads.size();
  if (2 * common < all)
    say(of(all - common, all) + " triangles of the file are not in the new mesh: " +
        std::to_string(start.imported->non_delaunay_edges) +
        " of its edges are not Delaunay, and Delaunay triangles took their places");
}

// A single airfoil replaces the mesh's own; several airfoils, or a domain, replace the whole domain.
ShapesDomain new_domain(const StartMesh& start, const UpdateCommand& command) {
  if (is_single_airfoil(command.shapes)) {
    const std::string& shape = command.shapes.shapes[0];
    ShapesDomain input;
    const CstFit fit = fit_shape(shape, command.fit, input.fits);
    input.domain = with_new_airfoil(start, command.start, fit.airfoil);
    validate_input(command.shapes, input.domain);
    return input;
  }
  if (!command.start.boundary.empty())
    throw Error(ErrorCode::argument, "--boundary",
                "given with a whole domain (several airfoils, a domain file, --place, --name or --as-given), "
                "expected one airfoil to put there");
  AirfoilDomainOptions discretisation = discretisation_of(start.mesh.domain());
  if (command.start.points) discretisation.points = *command.start.points;
  DomainInputOptions shapes = command.shapes;
  shapes.farfield_stays = true;
  ShapesDomain input = read_domain(shapes, discretisation, command.fit);
  if (input.in_farfield && shapes.names.empty()) take_names(input.domain, start.mesh.domain());
  if (input.in_farfield && !command.start.points)
    for (Loop& loop : input.domain.loops) take_stations(loop, start.mesh.domain());
  validate_input(shapes, input.domain);
  return input;
}

// What the step starts from, and what it is compared with.
struct Origin {
  StartMesh start;
  FrozenMesh before;  // start.mesh, as the step finds it
  FrozenMesh file;    // MESH as it was: the new mesh may be written in its place
};

Origin read_origin(const UpdateCommand& command) {
  const bool referenced = !command.reference.empty();
  Origin origin{read_start_mesh(referenced ? command.reference : command.mesh, command.start), {}, {}};
  origin.before = origin.start.mesh.freeze();
  if (referenced)
    origin.file = read_any_mesh(command.mesh).frozen;
  else
    origin.file = origin.start.imported ? read_frozen_mesh(command.mesh) : origin.before;
  return origin;
}

// With --reference on MESH itself; otherwise on the mesh that the step starts from, whose points an import
// may have renumbered.
Cargo cargo_of(const UpdateCommand& command, const Origin& origin) {
  Cargo cargo(command.mesh, origin.file, command.carry);
  if (command.reference.empty() && origin.start.imported && !cargo.empty()) {
    FrozenMesh by_places = origin.before;
    by_places.vertex_keys.clear();
    cargo.renumber(origin.file, by_places);
  }
  return cargo;
}

// The step was one of the reference's; whoever has MESH asks what of that is still there.
void count_against_mesh(RemodelResult& result, const Origin& origin, const FrozenMesh& after) {
  const InCommon common = in_common(origin.file, after, origin.before);
  result.triangles_before = origin.file.triangles.size();
  result.preserved = common.preserved;
  result.connected = common.connected;
  result.moved = common.moved;
  result.inserted = common.inserted;
  result.removed = common.removed;
}

void require_reference_kept(const UpdateCommand& command) {
  if (command.reference.empty()) return;
  if (command.start.points)
    throw Error(ErrorCode::argument, "--points",
                "given with --reference, expected one of them: a morph of the reference has its points");
  for (const std::string& file : command.outputs.files()) {
    std::error_code none_there;
    if (std::filesystem::equivalent(file, command.reference, none_there))
      throw Error(ErrorCode::argument, "-o",
                  "found '" + file + "', which is the reference, expected another file");
  }
}

// The same step `repeat` times; seconds of each.
std::vector<double> remodel_timed(const UpdateCommand& command, const Mesh& original, const Domain& domain,
                                  Mesh& mesh, RemodelResult& result) {
  InterruptObserver observer;
  RemodelOptions remodelling = command.remodelling;
  remodelling.observer = &observer;
  remodelling.regenerate = !command.no_regenerate;
  std::vector<double> seconds;
  for (int i = 0; i < command.repeat && result.stopped != Stopped::interrupted; ++i) {
    mesh = original;
    const Stopwatch watch;
    result = remodel(mesh, domain, remodelling);
    seconds.push_back(watch.seconds());
  }
  return seconds;
}

void add_settings(Report& report, const UpdateCommand& command, const ShapesDomain& input) {
  report.line("mesh", command.mesh);
  for (const std::string& shape : command.shapes.shapes) report.line("shape", shape);
  add_findings(report, input);
  report.figure("strategy", "strategy", name_of(command.remodelling.strategy));
  if (!command.reference.empty()) report.figure("reference", "reference", command.reference);
  report.line("removal distance D", Json(command.remodelling.distance).dump());
}

// What a mesh with layers has no use for, or is not there for it.
void require_for_layers(const UpdateCommand& command) {
  for (const char* option : {"--reference", "--boundary", "--points", "--refine-angle", "--non-delaunay"})
    if (command.given(option))
      throw Error(ErrorCode::argument, option,
                  "given for '" + command.mesh + "', a mesh with layers, expected a mesh without");
}

LayeredUpdate layered(const UpdateCommand& command) {
  require_for_layers(command);
  LayeredUpdate update = command;
  update.remodelling.regenerate = !command.no_regenerate;
  if (!command.given("--strategy")) update.remodelling.strategy = Strategy::morph;
  return update;
}

Status run(const UpdateCommand& command) {
  command.outputs.require_possible();
  require_coordinate_file(command.shapes.shapes, command.fit);
  const KeptPipes once;
  if (holds_layers(command.mesh)) {
    const LayeredUpdate update = layered(command);
    require_used(command.given, update.remodelling.strategy, false, command.mesh);
    return run_layered_update(update);
  }
  if (command.given("--layer-cells"))
    throw Error(ErrorCode::argument, "--layer-cells",
                "given for '" + command.mesh + "', expected a native mesh with layers");
  require_reference_kept(command);
  const Origin origin = read_origin(command);
  const StartMesh& start = origin.start;
  require_used(command.given, command.remodelling.strategy, start.mesh.imported(), command.mesh);
  Cargo cargo = cargo_of(command, origin);
  const ShapesDomain input = new_domain(start, command);

  Mesh mesh;
  RemodelResult result;
  const std::vector<double> seconds = remodel_timed(command, start.mesh, input.domain, mesh, result);
  const bool given_up = result.abandoned || result.stopped == Stopped::interrupted;
  const FrozenMesh after = mesh.freeze();
  if (!command.reference.empty()) count_against_mesh(result, origin, after);
  if (!given_up) {
    cargo.carry(command.reference.empty() ? origin.before : origin.file, after);
    command.outputs.with_boxes(start.su2_boxes).write(mesh, cargo.fields());
    cargo.write_state(after);
  }
  warn_of_losses(command, start, origin.file, after, result);

  Report report;
  add_settings(report, command, input);
  add_import_figures(report, start);
  add_step_figures(report, result);
  add_part_figures(report, mesh);
  const MeshStatistics statistics = mesh.statistics();
  report.figure("min_angle_deg", "smallest angle", smallest_angle(mesh), "degrees");
  add_exemption_figures(report, statistics.exempt_triangles, statistics.min_held_angle_deg);
  report.figure("keep", "kept triangles take up to", mesh.keep(), "H");
  report.figure("max_gradation", "largest r / (keep H mean LS)", statistics.max_gradation);
  add_gradation_error(report, mesh.gradation_error());
  report.figure("seconds", command.repeat > 1 ? "remodelling, median" : "remodelling", median(seconds),
                "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  warn_of_limit(result.stopped, mesh);
  cargo.add_figures(report);
  if (!given_up) add_output_figures(report, command.outputs.files());
  report.print(command.json);
  if (result.abandoned) return Status::answer_is_no;
  return result.stopped == Stopped::done ? Status::done : Status::limit;
}

// --reference has a strategy of its own.
void settle_strategy(UpdateCommand& command) {
  if (command.reference.empty()) return;
  if (command.given("--strategy") && command.remodelling.strategy != Strategy::reference)
    throw Error(ErrorCode::argument, "--strategy",
                std::string("found ") + name_of(command.remodelling.strategy) +
                    " with --reference, expected reference or none");
  command.remodelling.strategy = Strategy::reference;
}

}  // namespace

void add_update_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<UpdateCommand>();
  CLI::App& app = add_subcommand(
      program, "update", "Remodels a mesh to another airfoil, or to another domain", [command, &action] {
        settle_strategy(*command);
        action = [command] { return run(*command); };
      });
  add_text(app, {"mesh", "MESH", "", "Mesh: a native one (.vtkhdf), or .su2, .msh, .vtu with --boundary"},
           Presence::required, command->mesh);
  add_text(
      app,
      {"--reference", "MESH", "",
       "The new mesh is the morph of this one to the new shape, whatever MESH is; fields and figures are "
       "still those of MESH"},
      Presence::optional, command->reference);
  add_domain_input(app, command->shapes);
  add_start_mesh_options(app, command->start);
  add_integer(app,
              {"--points", "I", "as many as in the mesh", "Vertices on the new airfoil: even, 8 to 100000"},
              {.low = 8, .high = 100000, .even = true}, command->start.points);
  command->outputs.add_options(app, Presence::optional);
  add_layer_cells(app, command->cells);
  add_carry_options(app, command->carry);
  add_fit_options(app, command->fit);
  add_remodel_options(app, command->remodelling);
  add_step_strategy(app, command->remodelling);
  command->given = [&app](const std::string& name) { return given(app, name); };
  add_flag(app, "--no-regenerate",
           "Where the mesh would have to be generated afresh: exit status 1, and no mesh",
           command->no_regenerate);
  add_repeat(app, command->repeat);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
