// remodel polar SHAPE...: rows of flows over angles of attack or lift coefficients, each on the mesh of its
// shape.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "arguments.h"
#include "command.h"
#include "euler_run.h"
#include "figures.h"
#include "flow_mesh.h"
#include "flow_progress.h"
#include "flow_report.h"
#include "interrupt.h"
#include "number_text.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/polar.h"
#include "remodel/shape_files.h"
#include "shape_input.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct PolarCommand {
  DomainInputOptions input;
  MeshingOptions meshing;
  LayerChoice layers;
  PolarOptions polar;
  std::vector<std::string> files;
  bool json = false;
  std::function<bool(const char*)> given;  // whether an option is on the command line
};

bool has_friction(const PolarCommand& command) {
  return command.polar.flow.model != FlowModel::euler;
}

bool is_picture(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return extension == ".svg" || extension == ".png";
}

bool is_table(const std::string& file) {
  return std::filesystem::path(file).extension() == ".csv";
}

void require_possible_files(const PolarCommand& command) {
  std::set<std::filesystem::path> places;
  for (const std::string& file : command.files) {
    require_writable_as(file, {".csv", ".json", ".svg", ".png"});
    require_no_input(file, command.input.shapes);
    if (!places.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(file))).second)
      throw Error(ErrorCode::argument, "-o", "found '" + file + "' twice, expected different files");
  }
}

void require_consistent(const PolarCommand& command) {
  require_possible_files(command);
  if (!command.given("--mach"))
    throw Error(ErrorCode::argument, "--mach", "not given, expected the stream's Mach number, or M0:M1:DM");
  if (command.given("--alpha") == command.given("--cl"))
    throw Error(ErrorCode::argument, command.given("--cl") ? "--cl" : "--alpha",
                command.given("--cl") ? "given with --alpha, expected one of them"
                                      : "not given, expected angles A0:A1:DA, or lifts by --cl C0:C1:DC");
  if (command.polar.flow.model != FlowModel::sa)
    refuse_given(command.given, {"--transition"}, "given without turbulence, expected --model sa");
  if (!has_friction(command))
    return refuse_given(command.given, {"--reynolds", "--wall-temperature"},
                        "given without friction, expected --model laminar or sa");
  if (!command.given("--reynolds"))
    throw Error(ErrorCode::argument, "--reynolds",
                "not given, expected the Reynolds number of the reference length for --model laminar or sa");
  refuse_given(command.given, {"--limiter"}, "given with --model laminar or sa, expected --model euler");
}

// A mesh each, all of them before the first flow: what is wrong with the last shape is said at once.
std::vector<MeshInput> meshes_of(const PolarCommand& command) {
  require_coordinate_file(command.input.shapes, command.meshing.fit);
  std::vector<MeshInput> meshes;
  for (const std::string& shape : command.input.shapes) {
    FlowMeshRequest request{command.input,  command.meshing, command.polar.flow, command.polar.conditions,
                            command.layers, command.given};
    request.input.shapes = {shape};
    if (!is_pipe(shape) && !is_coordinate_file(shape)) request.meshing.fit.close_trailing_edge = false;
    meshes.push_back(flow_mesh(request));
  }
  return meshes;
}

// All curves, and which mesh each is of.
struct Polars {
  std::vector<PolarCurve> curves;
  std::vector<std::size_t> vertices;  // of each curve's mesh
  double seconds = 0.0;
  bool interrupted = false;
};

// Tables have each row once it is known: hours of flows outlive a machine that does not.
void write_tables(const PolarCommand& command, std::vector<PolarCurve> curves,
                  const std::vector<PolarCurve>& next) {
  if (std::none_of(command.files.begin(), command.files.end(), is_table)) return;
  curves.insert(curves.end(), next.begin(), next.end());
  for (const std::string& file : command.files)
    if (is_table(file)) write_text_atomically(file, polar_table(curves));
}

Polars find_all(const PolarCommand& command, const std::vector<MeshInput>& meshes) {
  Polars polars;
  InterruptObserver observer;
  PolarOptions options = command.polar;
  options.flow.observer = &observer;
  FlowProgressLine progress(options.flow);
  for (std::size_t i = 0; i < meshes.size() && !polars.interrupted; ++i) {
    const std::string& shape = command.input.shapes[i];
    options.on_search = [&](double mach, double value) {
      progress.begin(shape + "  M " + short_text(mach) + (options.alphas_deg.empty() ? "  CL " : "  angle ") +
                     short_text(value) + "  ");
    };
    options.on_curves = [&](const std::vector<PolarCurve>& curves) {
      write_tables(command, polars.curves, curves);
    };
    PolarResult result = meshes[i].living ? find_polar(*meshes[i].living, shape, options)
                                          : find_polar(meshes[i].frozen, shape, options);
    polars.vertices.insert(polars.vertices.end(), result.curves.size(), meshes[i].frozen.points.size());
    std::move(result.curves.begin(), result.curves.end(), std::back_inserter(polars.curves));
    polars.seconds += result.seconds;
    polars.interrupted = result.interrupted;
  }
  return polars;
}

// What is not a number is null.
Json to_json(const PolarCurve& curve, const PolarPoint& point) {
  Json json{{"shape", curve.name},
            {"mach", curve.mach},
            {"alpha_deg", point.alpha_deg},
            {"cl", point.cl},
            {"cd", point.cd},
            {"cm", point.cm},
            {"cd_pressure", point.cd_pressure},
            {"cd_friction", point.cd_friction},
            {"converged", point.converged},
            {"status", point.status ? name_of(*point.status) : "not-looked-for"},
            {"asked", point.asked},
            {"newton_steps", point.newton_steps},
            {"residual", point.residual},
            {"warm", name_of(point.start)},
            {"seconds", point.seconds}};
  if (curve.model != FlowModel::euler) json["y_plus_max"] = point.y_plus_max;
  if (point.bodies.size() > 1)
    json["bodies"] = bodies_json(point.bodies, !std::isnan(point.cl), curve.model != FlowModel::euler);
  if (!point.reason.empty()) json["reason"] = point.reason;
  if (!point.warnings.empty()) json["warnings"] = point.warnings;
  return json;
}

std::size_t found_in(const PolarCurve& curve) {
  return static_cast<std::size_t>(std::count_if(curve.points.begin(), curve.points.end(),
                                                [](const PolarPoint& p) { return p.converged; }));
}

Json to_json(const PolarCurve& curve, std::size_t vertices) {
  const std::optional<LargestLift> largest = largest_lift(curve);
  const std::size_t found = found_in(curve);
  return {{"shape", curve.name},
          {"mach", curve.mach},
          {"vertices", vertices},
          {"found", found},
          {"not_found", curve.points.size() - found},
          {"cl_max", largest ? Json(largest->cl) : Json(nullptr)},
          {"alpha_of_cl_max_deg", largest ? Json(largest->alpha_deg) : Json(nullptr)},
          {"cl_max_passed", largest ? Json(largest->passed) : Json(nullptr)}};
}

std::string text_of(const PolarPoint& point) {
  if (!point.converged) return (point.status ? "no flow: " : "") + point.reason;
  const auto coefficient = [](const char* label, double value) {
    return label + (std::isnan(value) ? "not determined" : short_text(value));
  };
  return coefficient("CL ", point.cl) + ", " + coefficient("CD ", point.cd) + ", " +
         coefficient("CM ", point.cm) + (point.asked ? "" : " (in between)");
}

std::string text_of(const std::optional<LargestLift>& largest) {
  if (!largest) return "none: no flow was found";
  return short_text(largest->cl) + " at " + short_text(largest->alpha_deg) + " degrees" +
         (largest->passed ? "" : ", the largest angle of a flow: lift still grows there");
}

void add_curve(Report& report, const PolarCurve& curve, std::size_t vertices) {
  report.line(curve.name, "M " + short_text(curve.mach) + ", " + std::to_string(vertices) + " vertices");
  for (const PolarPoint& point : curve.points)
    report.line(
        std::isnan(point.alpha_deg) ? "CL " + short_text(point.cl) : short_text(point.alpha_deg) + " degrees",
        text_of(point));
  report.line("largest CL", text_of(largest_lift(curve)));
}

Report report_of(const PolarCommand& command, const Polars& polars) {
  Report report;
  report.data("shapes", command.input.shapes);
  report.figure("model", "model", name_of(command.polar.flow.model));
  if (has_friction(command)) report.figure("reynolds", "Reynolds number", command.polar.conditions.reynolds);
  if (const auto& places = command.polar.conditions.transition)
    report.figure("transition", "transition of upper and lower sides", Json(*places));
  if (const auto& warmth = command.polar.conditions.wall_temperature)
    report.figure("wall_temperature", "temperature of walls, over the stream's", *warmth);
  Json points = Json::array(), curves = Json::array(), cl_max;
  std::size_t found = 0;
  for (std::size_t i = 0; i < polars.curves.size(); ++i) {
    const PolarCurve& curve = polars.curves[i];
    for (const PolarPoint& point : curve.points) points.push_back(to_json(curve, point));
    curves.push_back(to_json(curve, polars.vertices[i]));
    if (const auto largest = largest_lift(curve); largest && (cl_max.is_null() || largest->cl > cl_max))
      cl_max = largest->cl;
    add_curve(report, curve, polars.vertices[i]);
    found += found_in(curve);
  }
  const std::size_t not_found = points.size() - found;
  report.data("points", std::move(points));
  report.data("polars", std::move(curves));
  report.data("cl_max", std::move(cl_max));
  report.figure("found", "flows that were found", found);
  report.figure("not_found", "flows that were not found", not_found);
  report.data("interrupted", polars.interrupted);
  report.figure("seconds", "solving", polars.seconds, "seconds");
  return report;
}

// The files of what there is: after an interrupt of the rows so far.
void write_files(const PolarCommand& command, const Polars& polars, Report& report) {
  std::vector<std::string> written;
  const std::vector<Plot> plots = polar_plots(polars.curves);
  for (const std::string& file : command.files) {
    if (is_picture(file) && plots.empty()) {
      warn(file + ": not written: no flow with a lift was found, which a picture could show");
      continue;
    }
    written.push_back(file);
  }
  add_output_figures(report, written);
  for (const std::string& file : written) {
    const int in_a_row = plots.size() == 4 ? 2 : 3;
    if (is_picture(file))
      draw_plots(plots, in_a_row, file);
    else
      write_text_atomically(file, is_table(file) ? polar_table(polars.curves) : report.json_text());
  }
}

// Flows that this method does not find are an answer, a limit that ended a search is none.
Status status_of(const Polars& polars) {
  Status status = polars.interrupted ? Status::limit : Status::done;
  for (const PolarCurve& curve : polars.curves) {
    for (const PolarPoint& point : curve.points) {
      if (point.converged || status == Status::limit) continue;
      status = point.status && *point.status != FlowStatus::stalled ? Status::limit : Status::answer_is_no;
    }
  }
  return status;
}

Status run(const PolarCommand& command) {
  require_consistent(command);
  const std::vector<MeshInput> meshes = meshes_of(command);
  const Polars polars = find_all(command, meshes);
  for (const PolarCurve& curve : polars.curves)
    for (const std::string& warning : polar_warnings(curve))
      warn(curve.name + ", M " + short_text(curve.mach) + ": " + warning);
  Report report = report_of(command, polars);
  std::vector<ShapeFit> fits;
  for (const MeshInput& mesh : meshes) fits.insert(fits.end(), mesh.fits.begin(), mesh.fits.end());
  add_fit_figures(report, fits);
  write_files(command, polars, report);
  report.print(command.json);
  return status_of(polars);
}

void add_range(CLI::App& app, const OptionText& text, ValueRange range, std::vector<double>& values) {
  add_text(app, text, Presence::optional, [name = text.name, range, &values](const std::string& found) {
    values = parse_range(name, found, range);
  });
}

void add_conditions(CLI::App& app, PolarCommand& command) {
  add_range(app,
            {"--alpha", "A0:A1:DA", "",
             "Angles of attack in degrees, from A0 to A1 in steps of DA, or a single one: -90 to 90"},
            {-90, 90}, command.polar.alphas_deg);
  add_range(
      app,
      {"--cl", "C0:C1:DC", "", "In place of angles: lift coefficients that they are found for, -10 to 10"},
      {-10, 10}, command.polar.lifts);
  add_range(app, {"--mach", "M0:M1:DM", "", "Mach number of the stream, or several, a row each: 0.01 to 3"},
            {0.01, 3}, command.polar.machs);
  add_choice(
      app,
      {"--model", "MODEL", "euler",
       "euler: of a compressible gas without friction; laminar: with friction; sa: of its turbulent flow, by "
       "Spalart's and Allmaras's model"},
      {"euler", "laminar", "sa"}, [&](std::size_t choice) {
        command.polar.flow.model = choice == 0   ? FlowModel::euler
                                   : choice == 1 ? FlowModel::laminar
                                                 : FlowModel::sa;
      });
  add_real(
      app,
      {"--reynolds", "RE", "",
       "Reynolds number by the reference length, of models with friction: 1 to 1e10. A layer of cells on the "
       "walls follows from it where a shape is given"},
      {.low = 1.0, .high = 1e10}, command.polar.conditions.reynolds);
  add_friction_options(app, command.polar.conditions);
  add_integer(app,
              {"--halvings", "N", "3",
               "Where a flow is not found, the step from the last one is halved so many times: 0 to 20"},
              {.low = 0, .high = 20}, command.polar.halvings);
  add_integer(app,
              {"--misses", "N", "2",
               "So many values in a row without a flow end the row in that direction: 1 or more"},
              {.low = 1, .high = 1000}, command.polar.misses);
}

}  // namespace

void add_polar_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<PolarCommand>();
  CLI::App& app =
      add_command(program, "polar",
                  "Rows of flows over angles of attack, each from the last one: lift, drag and moment "
                  "of each shape on a mesh of its own, past the largest lift as far as steady flows are "
                  "found",
                  command, action);
  add_texts(app,
            {"shape", "SHAPE...", "",
             std::string(shape_help) + "; or a domain file (.json), a .poly file, or a mesh of any format"},
            Presence::required, command->input.shapes);
  add_conditions(app, *command);
  add_farfield(app, command->polar.flow.farfield);
  add_solver_options(app, command->polar.conditions, command->polar.flow);
  add_texts(app,
            {"-o,--output", "FILE", "",
             "Rows as a table (.csv), each of them once it is known, or as the report (.json); plots of all "
             "shapes (.svg, .png); may be repeated"},
            Presence::optional, command->files);
  add_reading_options(app, command->input);
  add_meshing_options(app, command->meshing);
  add_turning_share(app, command->meshing.discretisation);
  add_layer_sizes(app, command->layers, LayerDefaults::of_flow);
  add_json_flag(app, command->json);
  // Shapes have no names and no places: each is alone in its mesh.
  command->given = [&app](const char* option) {
    return std::string(option) != "--name" && given(app, option);
  };
}

}  // namespace remodel::app
