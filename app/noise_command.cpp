// remodel noise SHAPE --spacing S --count N: an objective along a line of designs, on fresh meshes, on one
// living mesh, on copies of a hub and on morphs of one reference. It answers whether finite differences can
// be used, and with which step.

#include "remodel/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "arguments.h"
#include "command.h"
#include "evaluate_options.h"
#include "figures.h"
#include "interrupt.h"
#include "meshing_options.h"
#include "outputs.h"
#include "remodel/airfoil.h"
#include "remodel/design_space.h"
#include "remodel/error.h"
#include "remodel/flow_noise.h"
#include "remodel/plot.h"
#include "shape_input.h"

namespace remodel::app {
namespace {

struct NoiseCommand {
  std::string shape, direction, picture;
  EvaluateOptions evaluate;
  MeshingOptions meshing;
  NoiseOptions line;
  std::optional<double> mach;
  FlowConditions conditions;
  FlowOptions flow{.tolerance = 1e-12};
  bool json = false;
};

Json to_json(const std::vector<std::string>& names, const NoiseSeries& series, bool has_adjoint) {
  Json json = Json::object();
  Json slope = Json::array(), error = Json::array(), step = Json::array(), step_error = Json::array();
  for (std::size_t k = 0; k < names.size(); ++k) {
    Json values = Json::array();
    for (const std::vector<double>& design : series.values)
      values.push_back(design.empty() ? Json(nullptr) : Json(design[k]));
    json[names[k] + "_rms"] = series.fits.empty() ? Json(nullptr) : Json(series.fits[k].rms);
    json[names[k]] = values;
    if (series.fits.empty()) continue;
    slope.push_back(series.fits[k].slope), error.push_back(series.fits[k].slope_error);
    step.push_back(series.fits[k].step), step_error.push_back(series.fits[k].step_error);
  }
  if (has_adjoint) json["adjoint"] = series.adjoint;
  json["slope"] = slope, json["slope_error"] = error, json["step"] = step, json["step_error"] = step_error;
  json["not_found"] =
      std::count_if(series.values.begin(), series.values.end(), [](const auto& v) { return v.empty(); });
  if (!series.failures.empty()) json["failures"] = series.failures;
  return json;
}

std::string table_row(const LineFit& fit, const double* adjoint) {
  char text[160];
  std::snprintf(text, sizeof text, "residual %.2e, slope %.8g +- %.1e", fit.rms, fit.slope, fit.slope_error);
  std::string row = text;
  if (adjoint != nullptr) {
    std::snprintf(text, sizeof text, ", by the adjoint %.8g", *adjoint);
    row += text;
  }
  if (fit.step > 0.0) {
    std::snprintf(text, sizeof text, ", best central differences: step %.1e, error %.1e", fit.step,
                  fit.step_error);
    row += text;
  }
  return row;
}

// Residuals of the first value, by size: they lie orders of magnitude apart.
void draw(const std::string& picture, const NoiseResult& result) {
  constexpr double least = 1e-17;
  Plot plot{.x = {.label = "distance along the line"},
            .y = {.label = "residual of " + result.names[0] + ", absolute", .logarithmic = true}};
  for (const NoiseSeries& series : result.series) {
    if (series.fits.empty()) continue;
    PlotCurve curve{name_of(series.meshes), {}};
    std::size_t found = 0;
    for (std::size_t i = 0; i < result.places.size(); ++i)
      if (!series.values[i].empty())
        curve.points.push_back(
            {result.places[i], std::max(least, std::abs(series.fits[0].residuals[found++]))});
    plot.curves.push_back(std::move(curve));
  }
  if (!plot.curves.empty()) draw_plot(plot, picture);
}

// The first reason of each way, on standard error.
void say_failures(const NoiseResult& result) {
  for (const NoiseSeries& series : result.series)
    if (!series.failures.empty())
      std::fprintf(stderr, "remodel: %s: %zu of %zu designs have no value: %s\n", name_of(series.meshes),
                   series.failures.size(), series.values.size(), series.failures.front().c_str());
}

NoiseResult measured(const NoiseCommand& command, StepObserver& observer) {
  require_coordinate_file({command.shape}, command.meshing.fit);
  const CstFit fit = fit_shape(command.shape, command.meshing.fit);
  const AirfoilSpace space(fit.airfoil, command.meshing.discretisation);
  NoiseOptions options = command.line;
  options.quality = command.meshing.resolved_quality();
  options.observer = &observer;
  if (!command.direction.empty())
    options.direction = parse_reals("--direction", command.direction, space.start().size());
  const auto evaluator = command.mach ? nullptr : shell_evaluator(command.evaluate);
  const auto objective =
      command.mach ? flow_line_objective(command.conditions, command.flow) : line_objective(*evaluator);
  try {
    return measure_noise(space, *objective, options);
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const std::string option : {"direction", "count", "spacing"})
      if (text.starts_with(option + ": "))
        throw Error(error.code(), "--" + option, text.substr(option.size() + 2));
    throw;
  }
}

void require_possible(const NoiseCommand& command) {
  if (!command.picture.empty()) require_writable_as(command.picture, {".svg", ".png"});
  if (command.mach.has_value() == !command.evaluate.command.empty())
    throw Error(ErrorCode::argument, "--mach",
                command.mach ? "given with --evaluate, expected one of them"
                             : "not given, expected --mach or --evaluate");
}

void add_series(Report& report, const NoiseCommand& command, const NoiseResult& result) {
  for (const NoiseSeries& series : result.series) {
    const std::string way = name_of(series.meshes);
    report.data(way, to_json(result.names, series, command.mach.has_value()));
    for (std::size_t k = 0; k < result.names.size(); ++k)
      report.line(way + ", " + result.names[k],
                  series.fits.empty()
                      ? "too few values were found"
                      : table_row(series.fits[k], series.adjoint.empty() ? nullptr : &series.adjoint[k]));
  }
}

Status run(const NoiseCommand& command) {
  require_possible(command);
  InterruptObserver observer;
  const NoiseResult result = measured(command, observer);
  if (!command.picture.empty()) draw(command.picture, result);
  say_failures(result);
  Report report;
  report.figure("shape", "shape", command.shape);
  report.figure("spacing", "spacing", command.line.spacing);
  report.figure("count", "designs", command.line.count);
  report.figure("degree", "degree of the polynomial", command.line.degree);
  report.data("places", result.places);
  add_series(report, command, result);
  if (result.stopped != Stopped::done) report.figure("stopped", "stopped", name_of(result.stopped));
  if (!command.picture.empty() && result.complete()) add_output_figures(report, {command.picture});
  report.print(command.json);
  if (result.stopped != Stopped::done) return Status::limit;
  return result.complete() ? Status::done : Status::answer_is_no;
}

void add_flow_options(CLI::App& app, NoiseCommand& command) {
  add_real(app, {"--mach", "M", "", "Mach number: the values are CL and CD of compressible flow; 0.01 to 3"},
           {.low = 0.01, .high = 3.0},
           [&](double value) { command.mach = value, command.conditions.mach = value; });
  add_real(app, {"--alpha", "DEG", "0", "Angle of attack in degrees, -90 to 90"}, {.low = -90, .high = 90},
           command.conditions.alpha_deg);
  add_real(
      app,
      {"--tolerance", "PART", "1e-12", "Residual of a flow, as a part of undisturbed flow's: 1e-13 to 1e-2"},
      {.low = 1e-13, .high = 1e-2}, command.flow.tolerance);
  add_evaluate_option(
      app,
      "In place of a flow: a shell command for each design, as for `remodel optimise`, whose result is a "
      "JSON object with an objective",
      command.evaluate);
}

}  // namespace

void add_noise_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<NoiseCommand>();
  CLI::App& app = add_command(
      program, "noise", "How smooth an objective is along a line of designs, by the way of making meshes",
      command, action);
  add_shape_argument(app, command->shape);
  add_text(app,
           {"--direction", "D1,D2,...", "all of the upper surface",
            "Direction in the space of shape coefficients, upper surface first: of any length but 0"},
           Presence::optional, command->direction);
  add_real(app, {"--spacing", "S", "0.001", "Distance between designs, in shape coefficients: above 0"},
           {.low = 0.0, .above_low = true}, command->line.spacing);
  add_integer(app, {"--count", "N", "21", "Designs on the line, the shape in their middle: 4 to 10000"},
              {.low = 4, .high = 10000}, command->line.count);
  add_integer(app, {"--degree", "N", "3", "Degree of the polynomial that is smooth enough: 1 to 20"},
              {.low = 1, .high = 20}, command->line.degree);
  add_flow_options(app, *command);
  add_text(app, {"-o,--output", "FILE", "", "Picture of the residuals: .svg or .png"}, Presence::optional,
           command->picture);
  add_meshing_options(app, command->meshing);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
