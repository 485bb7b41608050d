// remodel flow MESH|SHAPE...: the flow around bodies, its coefficients, fields and plots.

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <utility>

#include "arguments.h"
#include "command.h"
#include "domain_input.h"
#include "euler_run.h"
#include "figures.h"
#include "flow_files.h"
#include "flow_mesh.h"
#include "mesh_input.h"
#include "meshing_options.h"
#include "outputs.h"
#include "potential_run.h"
#include "remodel/error.h"

namespace remodel::app {
namespace {

struct FlowCommand {
  DomainInputOptions input;
  MeshingOptions meshing;
  LayerChoice layers;
  bool is_potential = false;
  FlowModel model = FlowModel::euler;
  bool has_friction() const { return model != FlowModel::euler; }
  double alpha_deg = 0.0;
  std::optional<double> lift;
  std::vector<std::string> farfield = FlowOptions().farfield;
  std::string cp_plot;
  bool json = false;
  EulerRun euler;
  MeshOutputs outputs;
  std::function<bool(const char*)> given;  // whether an option is on the command line
};

void refuse(const FlowCommand& command, std::initializer_list<const char*> options, const char* why) {
  refuse_given(command.given, options, why);
}

MeshInput read_input(const FlowCommand& command) {
  FlowOptions flow = options_of(command.euler);
  flow.farfield = command.farfield, flow.model = command.model;
  return flow_mesh(
      {command.input, command.meshing, flow, command.euler.conditions, command.layers, command.given});
}

// Any number of parts of a chord.
std::vector<double> parse_places(const std::string& option, const std::string& text) {
  const auto count = static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')) + 1;
  const std::vector<double> places = parse_reals(option, text, count);
  for (const double place : places)
    if (!(place >= 0.0 && place <= 1.0))
      throw Error(ErrorCode::argument, option, "found '" + text + "', expected numbers from 0 to 1");
  return places;
}

Status run_potential_flow(const FlowCommand& command, const MeshInput& input) {
  PotentialRun run;
  run.alpha_deg = command.alpha_deg;
  run.lift = command.lift;
  if (command.euler.mach_given) run.mach = command.euler.conditions.mach;
  run.cp_plot = command.cp_plot;
  run.json = command.json;
  run.options.farfield = command.farfield;
  run.options.reference = command.euler.conditions.reference;
  run.options.reference_length = command.euler.conditions.reference_length;
  run_potential(run, input, command.input.shapes.front(), command.outputs);
  return Status::done;
}

StartMesh start_mesh(const FlowCommand& command) {
  if (const auto file = mesh_file(command.input, command.given)) return read_start_mesh(*file, {});
  return {.mesh = std::move(*read_input(command).living),
          .source = command.input.shapes.front(),
          .imported = std::nullopt};
}

// Options that models with friction need, or do not know yet.
void require_fitting_model(const FlowCommand& command) {
  if (command.is_potential || command.model != FlowModel::sa)
    refuse(command, {"--transition"}, "given without turbulence, expected --model sa");
  if (!command.has_friction())
    return refuse(command, {"--reynolds", "--wall-temperature", "--cf-plot", "--wall-table", "--profiles"},
                  "given without friction, expected --model laminar or sa");
  if (!command.given("--reynolds"))
    throw Error(ErrorCode::argument, "--reynolds",
                "not given, expected the Reynolds number of the reference length for --model laminar or sa");
  refuse(command, {"--limiter"}, "given with --model laminar or sa, expected --model euler");
}

Status run(const FlowCommand& command) {
  command.outputs.require_possible();
  require_fitting_model(command);
  if (!command.euler.cf_plot.empty()) require_writable_as(command.euler.cf_plot, {".svg", ".png"});
  if (!command.euler.wall_table.empty()) require_writable_as(command.euler.wall_table, {".csv"});
  if (!command.euler.profiles.empty())
    require_writable_as(command.euler.profiles, {".csv"});
  else
    refuse(command, {"--profiles-at"}, "given without --profiles, expected a file to write them to");
  if (!command.cp_plot.empty()) require_writable_as(command.cp_plot, {".svg", ".png"});
  if (!command.euler.history.empty()) require_writable_as(command.euler.history, {".csv", ".svg", ".png"});
  require_different_files(command.outputs, {{"--cp-plot", command.cp_plot},
                                            {"--cf-plot", command.euler.cf_plot},
                                            {"--wall-table", command.euler.wall_table},
                                            {"--profiles", command.euler.profiles},
                                            {"--history", command.euler.history}});
  if (command.is_potential) {
    refuse(command,
           {"--tolerance", "--max-steps", "--memory", "--solver", "--limiter", "--series", "--gradient",
            "--compare", "--inlet", "--total-pressure", "--total-temperature", "--inlet-angle", "--outlet",
            "--pressure", "--symmetry", "--periodic", "--history", "--error"},
           "given with --model potential, expected --model euler");
    return run_potential_flow(command, read_input(command));
  }
  EulerRun euler = command.euler;
  euler.conditions.alpha_deg = command.alpha_deg;
  euler.conditions.cl = command.lift;
  euler.options.farfield = command.farfield;
  euler.options.model = command.model;
  euler.cp_plot = command.cp_plot;
  euler.json = command.json;
  if (euler.series.empty())
    return run_euler(euler, read_input(command), command.input.shapes.front(), command.outputs);
  if (!command.outputs.files().empty() || !euler.cp_plot.empty() || !euler.cf_plot.empty() ||
      !euler.wall_table.empty() || !euler.profiles.empty() || !euler.history.empty())
    throw Error(ErrorCode::argument, "--series",
                "given with a file to write, expected no file: there are many flows");
  refuse(command, {"--gradient", "--error"}, "given with --series, expected a single flow");
  const std::optional<std::string> file = mesh_file(command.input, command.given);
  if (!command.has_friction() && !(file && holds_layers(*file)))
    return run_series(euler, start_mesh(command));
  MeshInput input = read_input(command);
  if (!input.layered)
    throw Error(
        ErrorCode::argument, command.input.shapes.front(),
        "found a mesh without layers of its own, expected a shape or a native mesh with layers for --series "
        "with friction");
  return run_layered_series(euler, std::move(*input.layered), command.input.shapes.front());
}

}  // namespace

void add_flow_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<FlowCommand>();
  CLI::App& app = add_command(program, "flow", "The flow around airfoils, or through a mesh of any format",
                              command, action);
  add_domain_input(app, command->input);
  add_choice(
      app,
      {"--model", "MODEL", "euler",
       "euler: of a compressible gas without friction; potential: of an incompressible one, with "
       "pressures by "
       "Karman and Tsien's rule where --mach is given; laminar: of a compressible gas with friction; sa: of "
       "its turbulent flow, by Spalart's and Allmaras's model"},
      {"euler", "potential", "laminar", "sa"}, [command](std::size_t choice) {
        command->is_potential = choice == 1;
        command->model = choice < 2 ? FlowModel::euler : choice == 2 ? FlowModel::laminar : FlowModel::sa;
      });
  add_real(
      app,
      {"--reynolds", "RE", "",
       "Reynolds number by the reference length, of models with friction: 1 to 1e10. A layer of cells on the "
       "walls follows from it where a shape is given"},
      {.low = 1.0, .high = 1e10}, [command](double value) { command->euler.conditions.reynolds = value; });
  add_friction_options(app, command->euler.conditions);
  add_real(app, {"--alpha", "DEG", "0", "Angle of attack in degrees, -90 to 90"}, {.low = -90, .high = 90},
           command->alpha_deg);
  add_real(app, {"--cl", "CL", "", "Lift coefficient that the angle of attack is found for: -10 to 10"},
           {.low = -10, .high = 10}, command->lift);
  add_farfield(app, command->farfield);
  add_text(app, {"--cp-plot", "FILE", "", "Plot of the pressure coefficient along every body: .svg or .png"},
           Presence::optional, command->cp_plot);
  add_text(app,
           {"--cf-plot", "FILE", "", "Plot of the friction along every body, with friction: .svg or .png"},
           Presence::optional, command->euler.cf_plot);
  add_text(app,
           {"--wall-table", "FILE", "",
            "Table of what friction does along walls, with the boundary layer's thicknesses: .csv"},
           Presence::optional, command->euler.wall_table);
  add_text(app,
           {"--profiles", "FILE", "",
            "Table of velocities, temperatures and turbulence through boundary layers, with friction: .csv"},
           Presence::optional, command->euler.profiles);
  add_text(app,
           {"--profiles-at", "X,...", "0.25,0.5,0.75,0.95",
            "Where --profiles are taken on both sides of each wall: parts of its chord from 0 to 1"},
           Presence::optional, [=](const std::string& text) {
             command->euler.profiles_at = parse_places("--profiles-at", text);
           });
  add_euler_options(app, command->euler);
  add_duct_options(app, command->euler);
  command->outputs.add_options(app, Presence::optional);
  add_meshing_options(app, command->meshing);
  add_turning_share(app, command->meshing.discretisation);
  add_layer_sizes(app, command->layers, LayerDefaults::of_flow);
  add_json_flag(app, command->json);
  command->given = [&app](const char* option) { return given(app, option); };
}

}  // namespace remodel::app
