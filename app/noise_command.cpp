// remodel noise SHAPE --spacing S --count N: an objective along a line of designs, on fresh meshes, on one
// living mesh, on copies of a hub and on morphs of one reference. It answers whether finite differences can
// be used, and with which step.

#include "remodel/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
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
#include "remodel/evaluator.h"
#include "remodel/flow.h"
#include "remodel/generate.h"
#include "remodel/mesh_derivative.h"
#include "remodel/plot.h"
#include "remodel/remodel.h"
#include "shape_input.h"

namespace remodel::app {
namespace {

struct NoiseCommand {
  std::string shape, direction, picture;
  EvaluateOptions evaluate;
  MeshingOptions meshing;
  double spacing = 1e-3;
  int count = 21, degree = 3;
  std::optional<double> mach;
  FlowConditions conditions;
  FlowOptions flow{.tolerance = 1e-12};
  bool json = false;
};

// The values of one design, in the order of Objective::names; nothing where there are none.
using Values = std::optional<std::vector<double>>;

// How a mesh and its design become values.
struct Objective {
  std::vector<std::string> names;
  std::function<Values(const Mesh&, std::span<const double> design)> values;
  // By the adjoint method, on the mesh of the last values: slopes along a direction in the design, of length
  // 1. None where there is no such method.
  std::function<std::vector<double>(const Mesh&, std::span<const double> direction)> slopes = {};
  // Why there were no values, of each design without.
  std::shared_ptr<std::vector<std::string>> failures = std::make_shared<std::vector<std::string>>();
};

// One way of making the meshes of the line. Hub and reference are meshes of the design in the middle.
enum class Way { fresh, living, hub, reference };
constexpr const char* way_names[] = {"fresh", "living", "hub", "reference"};

// A new solver for each way of making meshes. With fresh meshes nothing of the last flow is of use.
Objective flow_objective(const NoiseCommand& command, StepObserver& observer, Way way) {
  const bool carry = way != Way::fresh;
  FlowOptions options = command.flow;
  options.observer = &observer;
  auto solver = std::make_shared<LivingFlow>(options);
  auto failures = std::make_shared<std::vector<std::string>>();
  return {{"cl", "cd"},
          [=, conditions = command.conditions](const Mesh& mesh, std::span<const double>) -> Values {
            if (!carry) solver->forget();
            const FlowResult flow = solver->solve(mesh, conditions);
            if (flow.converged() && flow.lift_determined) return std::vector{flow.cl, flow.cd};
            failures->push_back(
                flow.converged() ? "the lift is not determined: a body has no edge that the flow leaves from"
                                 : flow.reason);
            return std::nullopt;
          },
          [=](const Mesh& mesh, std::span<const double> direction) {
            // Of the line's meshes: those of a reference move with their airfoil, the first loop of their
            // domain.
            const std::size_t airfoil[] = {0};
            const MeshDerivative derivative =
                way == Way::reference ? MeshDerivative(mesh, airfoil) : MeshDerivative(mesh);
            const FlowGradients gradients = solver->gradients({}, {.moment = false, .angle = false});
            if (gradients.interrupted) throw Interrupted();
            std::vector<double> slopes;
            for (const FlowGradient* of : {&gradients.cl, &gradients.cd}) {
              // The domain's numbers begin with the airfoil's coefficients.
              const std::vector<double> by = derivative.vjp(of->points);
              slopes.push_back(std::inner_product(direction.begin(), direction.end(), by.begin(), 0.0));
            }
            return slopes;
          },
          failures};
}

// The same: a state that the command left is carried on where meshes are not fresh.
Objective command_objective(const NoiseCommand& command, StepObserver& observer, bool carry) {
  std::shared_ptr<Evaluator> evaluator = shell_evaluator(command.evaluate);
  auto state = std::make_shared<std::unique_ptr<EvaluatorState>>();
  auto failures = std::make_shared<std::vector<std::string>>();
  return {{"objective"},
          [=, &observer](const Mesh& mesh, std::span<const double> design) -> Values {
            if (!carry) state->reset();
            const MeshStep step;
            const EvaluationTask task{.design = design,
                                      .mesh = mesh,
                                      .step = step,
                                      .before = nullptr,
                                      .gradient = false,
                                      .observer = observer};
            try {
              const Evaluation evaluation = evaluator->evaluate(task, *state);
              if (std::isfinite(evaluation.objective)) return std::vector{evaluation.objective};
              failures->emplace_back("found an objective that is not finite");
            } catch (const std::exception& problem) {
              if (observer.cancelled()) return std::nullopt;
              failures->emplace_back(problem.what());
            }
            state->reset();
            return std::nullopt;
          },
          {},
          failures};
}

// The places of designs on the line, around 0, and the designs.
struct DesignLine {
  std::vector<double> direction;  // of length 1
  std::vector<double> places;
  std::vector<std::vector<double>> designs;
};

DesignLine line_of(const NoiseCommand& command, const AirfoilSpace& space) {
  const std::vector<double> start = space.start();
  std::vector<double> direction(start.size(), 0.0);
  if (command.direction.empty())
    std::fill_n(direction.begin(), direction.size() / 2, 1.0);
  else
    direction = parse_reals("--direction", command.direction, start.size());
  double length = 0.0;
  for (const double d : direction) length += d * d;
  if (!(length > 0.0))
    throw Error(ErrorCode::argument, "--direction", "found zeros alone, expected a direction");
  DesignLine line{.direction = direction, .places = {}, .designs = {}};
  for (double& d : line.direction) d /= std::sqrt(length);
  for (int i = 0; i < command.count; ++i) {
    const double place = (i - 0.5 * (command.count - 1)) * command.spacing;
    std::vector<double> design = start;
    for (std::size_t k = 0; k < design.size(); ++k) design[k] += place / std::sqrt(length) * direction[k];
    if (!space.feasible(design))
      throw Error(ErrorCode::argument, "--spacing",
                  "design " + std::to_string(i + 1) +
                      " of the line is no airfoil that can be meshed, expected "
                      "designs nearer to one another");
    line.places.push_back(place);
    line.designs.push_back(std::move(design));
  }
  return line;
}

Mesh finished_mesh(const Domain& domain, const QualityOptions& quality, StepObserver& observer) {
  GenerateResult result = generate(domain, quality, &observer);
  if (result.stopped == Stopped::interrupted) throw Interrupted();
  if (result.stopped != Stopped::done)
    throw Error(ErrorCode::argument, "noise",
                std::string("a mesh is unfinished (") + name_of(result.stopped) + "), expected whole ones");
  return std::move(result.mesh);
}

class LineMeshes {
 public:
  LineMeshes(Way way, const AirfoilSpace& space, const DesignLine& line, const QualityOptions& quality,
             StepObserver& observer)
      : way_(way), space_(space), quality_(quality), observer_(observer) {
    const std::size_t first = way == Way::living ? 0 : line.designs.size() / 2;
    if (way == Way::reference) quality_.refine_angle_deg = angle_with_slack(quality);
    if (way != Way::fresh) mesh_ = finished_mesh(space.domain(line.designs[first]), quality_, observer);
  }

  Mesh next(std::span<const double> design) {
    const Domain domain = space_.domain(design);
    if (way_ == Way::fresh) return finished_mesh(domain, quality_, observer_);
    const RemodelOptions options{.strategy = strategy(), .observer = &observer_};
    if (way_ == Way::living) {
      remodel(mesh_, domain, options);
      return mesh_;
    }
    Mesh copy = mesh_;
    remodel(copy, domain, options);
    return copy;
  }

 private:
  Strategy strategy() const {
    if (way_ == Way::reference) return Strategy::reference;
    return way_ == Way::living ? strategy_with_flows : default_strategy;
  }

  Way way_;
  const AirfoilSpace& space_;
  QualityOptions quality_;
  StepObserver& observer_;
  Mesh mesh_;
};

struct Series {
  std::vector<std::vector<double>> values;  // per design, as Objective::names; empty where there are none
  std::vector<LineFit> fits;                // as Objective::names; none where too few are left
  // By the adjoint method at place 0, as Objective::names: of an even number of designs the mean of the two
  // beside it. None where there is no such method, or no value.
  std::vector<double> adjoint;
  std::vector<std::string> failures;  // why there are no values, of each design without
};

// Whether a design of the line is in its middle.
bool is_middle(const DesignLine& line, std::size_t i) {
  const std::size_t count = line.designs.size();
  return i == count / 2 || (count % 2 == 0 && i + 1 == count / 2);
}

LineFit fit_of(const DesignLine& line, const Series& series, std::size_t k, int degree) {
  std::vector<double> places, values;
  for (std::size_t i = 0; i < line.places.size(); ++i) {
    if (series.values[i].empty()) continue;
    places.push_back(line.places[i]), values.push_back(series.values[i][k]);
  }
  return fit_line(places, values, degree);
}

Series evaluate(Way way, const Objective& objective, const DesignLine& line, const AirfoilSpace& space,
                const NoiseCommand& command, StepObserver& observer) {
  LineMeshes meshes(way, space, line, command.meshing.resolved_quality(), observer);
  Series series;
  std::vector<std::vector<double>> slopes;  // of the middle
  for (std::size_t i = 0; i < line.designs.size() && !observer.cancelled(); ++i) {
    const Mesh mesh = meshes.next(line.designs[i]);
    series.values.push_back(objective.values(mesh, line.designs[i]).value_or(std::vector<double>{}));
    if (objective.slopes && is_middle(line, i) && !series.values.back().empty())
      slopes.push_back(objective.slopes(mesh, line.direction));
  }
  if (slopes.size() == 2 - line.designs.size() % 2)
    for (std::size_t k = 0; k < objective.names.size(); ++k)
      series.adjoint.push_back(0.5 * (slopes.front()[k] + slopes.back()[k]));
  series.values.resize(line.designs.size());
  series.failures = *objective.failures;
  const auto found = static_cast<std::size_t>(
      std::count_if(series.values.begin(), series.values.end(), [](const auto& v) { return !v.empty(); }));
  if (found < static_cast<std::size_t>(command.degree) + 2) return series;
  for (std::size_t k = 0; k < objective.names.size(); ++k)
    series.fits.push_back(fit_of(line, series, k, command.degree));
  return series;
}

Json to_json(const Objective& objective, const Series& series) {
  Json json = Json::object();
  Json slope = Json::array(), error = Json::array(), step = Json::array(), step_error = Json::array();
  for (std::size_t k = 0; k < objective.names.size(); ++k) {
    const std::string rms = objective.names[k] + "_rms";
    Json values = Json::array();
    for (const std::vector<double>& design : series.values)
      values.push_back(design.empty() ? Json(nullptr) : Json(design[k]));
    json[rms] = series.fits.empty() ? Json(nullptr) : Json(series.fits[k].rms);
    json[objective.names[k]] = values;
    if (series.fits.empty()) continue;
    slope.push_back(series.fits[k].slope), error.push_back(series.fits[k].slope_error);
    step.push_back(series.fits[k].step), step_error.push_back(series.fits[k].step_error);
  }
  if (objective.slopes) json["adjoint"] = series.adjoint;
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
void draw(const NoiseCommand& command, const DesignLine& line, const Objective& objective,
          const std::vector<Series>& all) {
  constexpr double least = 1e-17;
  Plot plot{.x = {.label = "distance along the line"},
            .y = {.label = "residual of " + objective.names[0] + ", absolute", .logarithmic = true}};
  for (std::size_t w = 0; w < all.size(); ++w) {
    if (all[w].fits.empty()) continue;
    PlotCurve curve{way_names[w], {}};
    std::size_t found = 0;
    for (std::size_t i = 0; i < line.places.size(); ++i)
      if (!all[w].values[i].empty())
        curve.points.push_back(
            {line.places[i], std::max(least, std::abs(all[w].fits[0].residuals[found++]))});
    plot.curves.push_back(std::move(curve));
  }
  if (!plot.curves.empty()) draw_plot(plot, command.picture);
}

// The first reason of each way, on standard error.
void say_failures(const std::vector<Series>& all) {
  for (std::size_t w = 0; w < all.size(); ++w)
    if (const auto& failures = all[w].failures; !failures.empty())
      std::fprintf(stderr, "remodel: %s: %zu of %zu designs have no value: %s\n", way_names[w],
                   failures.size(), all[w].values.size(), failures.front().c_str());
}

Status run(const NoiseCommand& command) {
  if (!command.picture.empty()) require_writable_as(command.picture, {".svg", ".png"});
  if (command.mach.has_value() == !command.evaluate.command.empty())
    throw Error(ErrorCode::argument, "--mach",
                command.mach ? "given with --evaluate, expected one of them"
                             : "not given, expected --mach or --evaluate");
  if (command.count < command.degree + 2)
    throw Error(ErrorCode::argument, "--count",
                "found " + std::to_string(command.count) + ", expected at least two more than --degree, " +
                    std::to_string(command.degree + 2));
  require_coordinate_file({command.shape}, command.meshing.fit);
  const CstFit fit = fit_shape(command.shape, command.meshing.fit);
  const AirfoilSpace space(fit.airfoil, command.meshing.discretisation);
  const DesignLine line = line_of(command, space);
  InterruptObserver observer;
  std::vector<Series> all;
  Objective objective;
  for (const Way way : {Way::fresh, Way::living, Way::hub, Way::reference}) {
    objective = command.mach ? flow_objective(command, observer, way)
                             : command_objective(command, observer, way != Way::fresh);
    all.push_back(evaluate(way, objective, line, space, command, observer));
  }
  const bool whole =
      std::none_of(all.begin(), all.end(), [](const Series& series) { return series.fits.empty(); });
  if (!command.picture.empty()) draw(command, line, objective, all);

  say_failures(all);

  Report report;
  report.figure("shape", "shape", command.shape);
  report.figure("spacing", "spacing", command.spacing);
  report.figure("count", "designs", command.count);
  report.figure("degree", "degree of the polynomial", command.degree);
  report.data("places", line.places);
  for (std::size_t w = 0; w < all.size(); ++w) {
    report.data(way_names[w], to_json(objective, all[w]));
    for (std::size_t k = 0; k < objective.names.size(); ++k)
      report.line(std::string(way_names[w]) + ", " + objective.names[k],
                  all[w].fits.empty()
                      ? "too few values were found"
                      : table_row(all[w].fits[k], all[w].adjoint.empty() ? nullptr : &all[w].adjoint[k]));
  }
  if (!command.picture.empty() && whole) add_output_figures(report, {command.picture});
  report.print(command.json);
  return observer.cancelled() ? Status::limit : whole ? Status::done : Status::answer_is_no;
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
           {.low = 0.0, .above_low = true}, command->spacing);
  add_integer(app, {"--count", "N", "21", "Designs on the line, the shape in their middle: 4 to 10000"},
              {.low = 4, .high = 10000}, command->count);
  add_integer(app, {"--degree", "N", "3", "Degree of the polynomial that is smooth enough: 1 to 20"},
              {.low = 1, .high = 20}, command->degree);
  add_flow_options(app, *command);
  add_text(app, {"-o,--output", "FILE", "", "Picture of the residuals: .svg or .png"}, Presence::optional,
           command->picture);
  add_meshing_options(app, command->meshing);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
