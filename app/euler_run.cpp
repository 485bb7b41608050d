#include "euler_run.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "arguments.h"
#include "figures.h"
#include "flow_files.h"
#include "flow_progress.h"
#include "flow_report.h"
#include "interrupt.h"
#include "remodel/boundary_layer.h"
#include "remodel/error.h"
#include "remodel/flow_error.h"
#include "remodel/flow_plots.h"
#include "remodel/io.h"
#include "shape_input.h"

namespace remodel::app {

void require_mach(const EulerRun& run) {
  if (!run.mach_given)
    throw Error(ErrorCode::argument, "--mach",
                "not given, expected the stream's Mach number, or --model potential");
}

Status status_of(const FlowResult& flow) {
  switch (flow.status) {
    case FlowStatus::converged:
      return Status::done;
    case FlowStatus::stalled:
      return Status::answer_is_no;
    default:
      return Status::limit;
  }
}

namespace {

FrozenMesh without_openings(const FrozenMesh& mesh, const FlowOptions& options) {
  std::vector<std::string> names;
  for (const FlowInlet& inlet : options.inlets) names.push_back(inlet.name);
  for (const FlowOutlet& outlet : options.outlets) names.push_back(outlet.name);
  for (const FlowPeriod& pair : options.periodic) names.push_back(pair.name), names.push_back(pair.moved);
  for (const auto& pair : mesh.periodic) names.insert(names.end(), pair.begin(), pair.end());
  return without_boundaries(mesh, names);
}

}  // namespace

void add_farfield(CLI::App& app, std::vector<std::string>& names) {
  add_texts(app,
            {"--farfield", "NAME", "farfield",
             "Boundary that is open to the stream; may be given several times; all others are walls"},
            Presence::optional, names);
}

void add_solver_options(CLI::App& app, FlowConditions& conditions, FlowOptions& options) {
  add_real(app,
           {"--tolerance", "PART", "1e-10",
            "Converged: the residual as a part of undisturbed flow's, 1e-13 to 1e-2"},
           {.low = 1e-13, .high = 1e-2}, options.tolerance);
  add_integer(app, {"--max-steps", "N", "200", "Newton steps of one flow: at least 1"},
              {.low = 1, .high = 100000}, options.max_steps);
  add_real(app,
           {"--memory", "MB", "4096",
            "What the factors of a matrix may take, megabytes: at least 1; where LU takes more, GMRES with "
            "incomplete factors takes its place"},
           {.low = 1.0, .high = 1e9}, options.memory_mb);
  add_choice(
      app,
      {"--solver", "SOLVER", "auto",
       "Linear systems: by lu, by gmres, or by gmres far from a flow and by lu where its factors serve "
       "for several steps or designs"},
      {"auto", "lu", "gmres"}, [&](std::size_t choice) {
        if (choice > 0) options.solver = choice == 1 ? FlowSolver::lu : FlowSolver::gmres;
      });
  add_real(app,
           {"--limiter", "K", "30",
            "Differences below (K h)^(3/2) along an edge are not limited, h being its length over the "
            "walls' extent, the chord of a section: above 0, no unit"},
           {.low = 0.0, .above_low = true}, options.limiter);
  add_text(app, {"--reference", "X,Y", "0.25,0", "Point of the moment and of the far field's vortex"},
           Presence::optional, [&](const std::string& text) {
             const std::vector<double> point = parse_reals("--reference", text, 2);
             conditions.reference = {point[0], point[1]};
           });
  add_real(app,
           {"--reference-length", "LENGTH", "1",
            "Length that coefficients are made with, and --reynolds: above 0"},
           {.low = 0.0, .above_low = true}, conditions.reference_length);
}

void add_friction_options(CLI::App& app, FlowConditions& conditions) {
  add_text(
      app,
      {"--transition", "XU,XL", "0,0",
       "With --model sa: where the boundary layers of upper and lower sides become turbulent, as parts of "
       "the chord from 0 to 1"},
      Presence::optional, [&](const std::string& text) {
        const std::vector<double> places = parse_reals("--transition", text, 2);
        for (const double place : places)
          if (!(place >= 0.0 && place <= 1.0))
            throw Error(ErrorCode::argument, "--transition",
                        "found '" + text + "', expected two numbers from 0 to 1");
        conditions.transition = {places[0], places[1]};
      });
  add_real(
      app,
      {"--wall-temperature", "PART", "",
       "With --model laminar or sa: temperature of all walls, a part of the stream's static temperature: "
       "above 0; otherwise no heat passes through walls"},
      {.low = 0.0, .above_low = true}, conditions.wall_temperature);
}

void add_euler_options(CLI::App& app, EulerRun& run) {
  add_real(app, {"--mach", "M", "", "Mach number of the stream, of compressible flow: 0.01 to 3"},
           {.low = 0.01, .high = 3.0},
           [&](double value) { run.conditions.mach = value, run.mach_given = true; });
  add_solver_options(app, run.conditions, run.options);
  add_text(app,
           {"--series", "FILE", "",
            "JSON array of airfoils: the mesh is remodelled to one after the other, each flow found from the "
            "last"},
           Presence::optional, run.series);
  add_flag(app, "--gradient",
           "Also derivatives of the coefficients by the shape's numbers, with the mesh's interior along, the "
           "Mach number and the angle (or lift)",
           run.gradient);
  add_flag(
      app, "--error",
      "Also how far the coefficients are from those of an infinitely fine mesh: an estimate by one more mesh "
      "with half the edges' length",
      run.error);
  add_choice(app,
             {"--compare", "WITH", "nothing",
              "With --series: also solve each design on a fresh mesh, cold or (rival) from the flow before"},
             {"cold", "rival"},
             [&](std::size_t choice) { run.compare = choice == 0 ? Compare::cold : Compare::rival; });
}

namespace {

FlowResult solve(const EulerRun& run, const MeshInput& input, const std::string& source, LivingFlow& living,
                 const FlowOptions& options) {
  if (run.gradient)
    return input.living ? living.solve(*input.living, run.conditions)
                        : living.solve(input.frozen, run.conditions);
  return input.living ? solve_flow(*input.living, run.conditions, options, source)
                      : solve_flow(input.frozen, run.conditions, options, source);
}

void require_possible(const EulerRun& run, const MeshInput& input) {
  require_mach(run);
  if (run.compare != Compare::none)
    throw Error(ErrorCode::argument, "--compare", "given without --series, expected a series to compare");
  if (run.gradient && !input.living && !input.layered)
    throw Error(ErrorCode::argument, "--gradient",
                "given with the mesh of another program, expected a shape or a native mesh, whose curves are "
                "known");
  if (run.error && !input.living && !input.layered)
    throw Error(
        ErrorCode::argument, "--error",
        "given with the mesh of another program, expected a shape or a native mesh, of which a finer one "
        "can be made");
}

// Files of a flow, or of a search that found none, which has residuals alone.
std::vector<std::string> write_files(const EulerRun& run, const MeshInput& input, const std::string& source,
                                     const MeshOutputs& outputs, const FlowOptions& options,
                                     const FlowResult& flow) {
  std::vector<std::string> files;
  const std::string caption = options.inlets.empty() && options.outlets.empty()
                                  ? flow_caption(flow.mach, flow.alpha_deg, determined_lift(flow))
                                  : duct_caption(flow.mach);
  if (flow.converged()) {
    write_with_fields(outputs, input, fields_of(flow));
    say_flow_left_out(outputs);
    files = outputs.files();
    if (!run.cp_plot.empty()) {
      draw_plot(cp_plot(without_openings(input.frozen, options), options.farfield,
                        pressure_coefficients(flow), caption, "--cp-plot"),
                run.cp_plot);
      files.push_back(run.cp_plot);
    }
    if (!run.cf_plot.empty()) {
      draw_plot(cf_plot(without_openings(input.frozen, options), options.farfield, flow.friction->cf, caption,
                        "--cf-plot"),
                run.cf_plot);
      files.push_back(run.cf_plot);
    }
    if (!run.wall_table.empty()) {
      write_text_atomically(run.wall_table, boundary_layer_table(input.frozen, flow));
      files.push_back(run.wall_table);
    }
    if (!run.profiles.empty()) {
      const auto profiles = boundary_layer_profiles(input.frozen, flow, run.profiles_at);
      if (std::all_of(profiles.begin(), profiles.end(),
                      [](const auto& profile) { return profile.points.empty(); }))
        print_warnings(source, {"no columns of quadrilaterals stand on its walls, expected a layer: " +
                                run.profiles + " has no profiles"});
      write_text_atomically(run.profiles, boundary_layer_profile_table(input.frozen, profiles));
      files.push_back(run.profiles);
    }
  }
  if (!run.history.empty()) {
    write_residuals(flow.history, flow.converged() ? caption : "not converged", run.history);
    files.push_back(run.history);
  }
  if (!flow.converged())
    std::fprintf(stderr, "remodel: %s: no flow was found: %s; nothing was written%s\n", source.c_str(),
                 flow.reason.c_str(), files.empty() ? "" : (" but residuals to " + run.history).c_str());
  return files;
}

// What keeps errors from being estimated is a warning: the flow was found.
FlowError error_of(const EulerRun& run, const MeshInput& input, const FlowOptions& options,
                   const std::string& source, FlowResult& flow) {
  FlowError error;
  try {
    error = input.layered ? estimate_error(*input.layered, flow, run.conditions, options, source)
                          : estimate_error(*input.living, flow, run.conditions, options, source);
    if (!error.finer.converged())
      flow.warnings.push_back("the errors are not estimated: on the finer mesh no flow was found: " +
                              error.finer.reason);
  } catch (const Error& problem) {
    flow.warnings.push_back(std::string("the errors are not estimated: ") + problem.what());
  }
  return error;
}

}  // namespace

Status run_euler(const EulerRun& run, const MeshInput& input, const std::string& source,
                 const MeshOutputs& outputs) {
  require_possible(run, input);
  InterruptObserver observer;
  FlowOptions options = options_of(run);
  options.observer = &observer;
  FlowResult flow;
  Json gradients;
  std::optional<FlowError> error;
  {
    const FlowProgressLine progress(options);
    LivingFlow living(options);
    flow = solve(run, input, source, living, options);
    if (run.gradient && flow.converged())
      gradients = gradients_json(living, input, flow, run.conditions, options.farfield);
    if (run.error && flow.converged()) error = error_of(run, input, options, source, flow);
  }
  const std::vector<std::string> files = write_files(run, input, source, outputs, options, flow);
  print_warnings(source, flow.warnings);
  Report report;
  add_flow_mesh(report, source, name_of(options.model), input.frozen);
  add_fit_figures(report, input.fits);
  add_flow_figures(report, flow, run.conditions);
  if (!gradients.is_null()) add_gradients(report, gradients);
  if (error) add_error(report, *error);
  if (flow.converged() || !files.empty()) add_output_figures(report, files);
  report.print(run.json);
  const bool interrupted = flow.converged() && ((run.gradient && gradients.is_null()) ||
                                                (error && error->finer.status == FlowStatus::interrupted));
  return interrupted ? Status::limit : status_of(flow);
}

}  // namespace remodel::app
