#include "euler_run.h"

#include <algorithm>
#include <cstdio>

#include "arguments.h"
#include "figures.h"
#include "flow_plots.h"
#include "interrupt.h"
#include "new_airfoil.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/mesh_derivative.h"
#include "remodel/remodel.h"
#include "report.h"

namespace remodel::app {
namespace {

void require_mach(const EulerRun& run) {
  if (!run.mach_given)
    throw Error(ErrorCode::argument, "--mach",
                "not given, expected the stream's Mach number, or --model potential");
}

Json to_json(const FlowResult& flow) {
  Json json{{"cl", flow.cl},
            {"cd", flow.cd},
            {"cm", flow.cm},
            {"alpha_deg", flow.alpha_deg},
            {"mach", flow.mach},
            {"converged", flow.converged()},
            {"status", name_of(flow.status)}};
  if (!flow.reason.empty()) json["reason"] = flow.reason;
  json["residual"] = flow.residual;
  json["newton_steps"] = flow.newton_steps;
  json["coarse_steps"] = flow.coarse_steps;
  json["factorisations"] = flow.factorisations;
  json["krylov_iterations"] = flow.krylov_iterations;
  json["corrected_vertices"] = flow.corrected_vertices;
  json["solver"] = name_of(flow.solver);
  json["gmres_iterations"] = flow.gmres_iterations;
  json["memory_mb"] = flow.memory_mb;
  json["seconds"] = flow.seconds;
  json["warm"] = name_of(flow.start);
  return json;
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

void warn(const std::string& source, const FlowResult& flow) {
  std::fprintf(stderr, "remodel: %s: no flow was found: %s; nothing was written\n", source.c_str(),
               flow.reason.c_str());
}

void add_flow_figures(Report& report, const FlowResult& flow) {
  const Json figures = to_json(flow);
  const auto figure = [&](const char* key, const char* label, const char* unit = "") {
    if (figures.contains(key)) report.figure(key, label, figures.at(key), unit);
  };
  figure("cl", "CL"), figure("cd", "CD"), figure("cm", "CM");
  figure("alpha_deg", "angle of attack", "degrees");
  figure("mach", "Mach number");
  figure("converged", "converged"), figure("status", "ended"), figure("reason", "because");
  figure("residual", "residual, of undisturbed flow's");
  figure("newton_steps", "Newton steps");
  figure("factorisations", "factorisations");
  figure("krylov_iterations", "steps with older factors");
  report.data("corrected_vertices", figures.at("corrected_vertices"));
  figure("solver", "linear solver");
  if (flow.gmres_iterations > 0)
    figure("gmres_iterations", "steps of GMRES");
  else
    report.data("gmres_iterations", figures.at("gmres_iterations"));
  figure("memory_mb", "factors", "MB");
  figure("seconds", "solving", "seconds");
  report.data("warm", figures.at("warm"));
  Json bodies = Json::array();
  for (const FlowBody& body : flow.bodies) {
    bodies.push_back({{"name", body.name}, {"cl", body.cl}, {"cd", body.cd}, {"cm", body.cm}});
    if (flow.bodies.size() > 1)
      report.line("body " + body.name, "CL " + Json(body.cl).dump() + ", CD " + Json(body.cd).dump());
  }
  report.data("bodies", bodies);
  Json openings = Json::array();
  for (const FlowOpening& opening : flow.openings) {
    openings.push_back({{"name", opening.name}, {"mass_flow", opening.mass_flow}});
    report.line("boundary " + opening.name, "mass flow " + Json(opening.mass_flow).dump());
  }
  if (!openings.empty()) report.data("openings", openings);
  report.data("history", flow.history);
}

FrozenMesh without_openings(FrozenMesh mesh, const FlowOptions& options) {
  std::erase_if(mesh.boundaries, [&](const FrozenBoundary& boundary) {
    const auto is_named = [&](const auto& opening) { return opening.name == boundary.name; };
    return std::any_of(options.inlets.begin(), options.inlets.end(), is_named) ||
           std::any_of(options.outlets.begin(), options.outlets.end(), is_named);
  });
  return mesh;
}

// A JSON array of airfoils, each as `remodel fit` writes it.
std::vector<CstAirfoil> read_series(const std::string& file) {
  Json list;
  try {
    list = Json::parse(read_text(file));
  } catch (const Json::exception&) {
    throw Error(ErrorCode::format, file, "found no JSON, expected an array of airfoils");
  }
  if (!list.is_array() || list.empty())
    throw Error(ErrorCode::format, file,
                std::string("found ") + (list.is_array() ? "an empty array" : list.type_name()) +
                    ", expected an array of airfoils as `remodel fit` writes them");
  std::vector<CstAirfoil> airfoils;
  for (const Json& entry : list)
    airfoils.push_back(
        airfoil_from_json(entry.dump(), file + ", airfoil " + std::to_string(airfoils.size() + 1)));
  return airfoils;
}

// The same designs on fresh meshes, for comparison.
class Comparison {
 public:
  Comparison(Compare kind, const QualityOptions& quality, const FlowConditions& conditions,
             const FlowOptions& options)
      : kind_(kind), quality_(quality), conditions_(conditions), options_(options) {}

  void add(const Domain& domain, Json& entry) {
    if (kind_ == Compare::none) return;
    const Mesh fresh = generate(domain, quality_).mesh;
    FrozenMesh mesh = fresh.freeze();
    const bool cold = kind_ == Compare::cold || !flow_;
    FlowResult flow = cold ? solve_flow(fresh, conditions_, options_)
                           : solve_flow_from(mesh_, *flow_, mesh, conditions_, options_);
    entry[kind_ == Compare::cold ? "cold_seconds" : "rival_seconds"] = flow.seconds;
    entry[kind_ == Compare::cold ? "cold_cl" : "rival_cl"] = flow.cl;
    if (!flow.converged()) return;
    flow_ = std::move(flow), mesh_ = std::move(mesh);
  }

 private:
  Compare kind_;
  QualityOptions quality_;
  FlowConditions conditions_;
  FlowOptions options_;
  FrozenMesh mesh_;
  std::optional<FlowResult> flow_;
};

}  // namespace

void add_euler_options(CLI::App& app, EulerRun& run) {
  add_real(app, {"--mach", "M", "", "Mach number of the stream, of compressible flow: 0.01 to 3"},
           {.low = 0.01, .high = 3.0},
           [&](double value) { run.conditions.mach = value, run.mach_given = true; });
  add_real(app,
           {"--tolerance", "PART", "1e-10",
            "Converged: the residual as a part of undisturbed flow's, 1e-13 to 1e-2"},
           {.low = 1e-13, .high = 1e-2}, [&](double value) { run.options.tolerance = value; });
  add_integer(app, {"--max-steps", "N", "200", "Newton steps of one flow: at least 1"},
              {.low = 1, .high = 100000},
              [&](std::int64_t value) { run.options.max_steps = static_cast<int>(value); });
  add_real(app,
           {"--memory", "MB", "4096",
            "What the factors of a matrix may take, megabytes: at least 1; where LU takes more, GMRES with "
            "incomplete factors takes its place"},
           {.low = 1.0, .high = 1e9}, [&](double value) { run.options.memory_mb = value; });
  add_choice(
      app,
      {"--solver", "SOLVER", "auto",
       "Linear systems: by lu, by gmres, or by gmres far from a flow and by lu where its factors serve "
       "for several steps or designs"},
      {"auto", "lu", "gmres"}, [&](std::size_t choice) {
        if (choice > 0) run.options.solver = choice == 1 ? FlowSolver::lu : FlowSolver::gmres;
      });
  add_real(app,
           {"--limiter", "K", "30",
            "Differences below (K h)^(3/2) along an edge of length h are not limited: above 0, no unit"},
           {.low = 0.0, .above_low = true}, [&](double value) { run.options.limiter = value; });
  add_text(app, {"--reference", "X,Y", "0.25,0", "Point of the moment and of the far field's vortex"},
           Presence::optional, [&](const std::string& text) {
             const std::vector<double> point = parse_reals("--reference", text, 2);
             run.conditions.reference = {point[0], point[1]};
           });
  add_real(app, {"--reference-length", "LENGTH", "1", "Length that coefficients are made with: above 0"},
           {.low = 0.0, .above_low = true}, [&](double value) { run.conditions.reference_length = value; });
  add_text(app,
           {"--series", "FILE", "",
            "JSON array of airfoils: the mesh is remodelled to one after the other, each flow found from the "
            "last"},
           Presence::optional, run.series);
  add_flag(
      app, "--gradient",
      "Also derivatives of the coefficients by the shape's numbers, the Mach number and the angle (or lift)",
      run.gradient);
  add_choice(app,
             {"--compare", "WITH", "nothing",
              "With --series: also solve each design on a fresh mesh, cold or (rival) from the flow before"},
             {"cold", "rival"},
             [&](std::size_t choice) { run.compare = choice == 0 ? Compare::cold : Compare::rival; });
}

namespace {

// Derivatives by coefficients_of() the mesh's domain, the Mach number and what is given of angle and lift.
// Null where they were interrupted.
Json gradients_json(LivingFlow& living, const Mesh& mesh, const FlowConditions& conditions) {
  const FlowGradients gradients = living.gradients();
  if (gradients.interrupted) return nullptr;
  const MeshDerivative derivative(mesh);
  Json json = Json::object();
  const auto note = [&](const char* name, const FlowGradient& gradient) {
    json[name] = {{"coefficients", derivative.vjp(gradient.points)}, {"mach", gradient.mach}};
    if (conditions.cl)
      json[name]["cl"] = gradient.cl;
    else
      json[name]["alpha_deg"] = gradient.alpha_deg;
  };
  note("cl", gradients.cl), note("cd", gradients.cd), note("cm", gradients.cm);
  if (conditions.cl) note("alpha_deg", gradients.alpha_deg);
  json["seconds"] = gradients.seconds;
  return json;
}

}  // namespace

Status run_euler(const EulerRun& run, const MeshInput& input, const std::string& source,
                 const MeshOutputs& outputs) {
  require_mach(run);
  if (run.compare != Compare::none)
    throw Error(ErrorCode::argument, "--compare", "given without --series, expected a series to compare");
  if (!run.history.empty()) require_writable_as(run.history, {".csv", ".svg", ".png"});
  InterruptObserver observer;
  FlowOptions options = options_of(run);
  options.observer = &observer;
  if (run.gradient && !input.living)
    throw Error(ErrorCode::argument, "--gradient",
                "given with the mesh of another program, expected a shape or a native mesh, whose curves are "
                "known");
  LivingFlow living(options);
  const FlowResult flow = run.gradient   ? living.solve(*input.living, run.conditions)
                          : input.living ? solve_flow(*input.living, run.conditions, options, source)
                                         : solve_flow(input.frozen, run.conditions, options, source);
  std::vector<std::string> files;
  const std::string caption = flow_caption(flow.mach, flow.alpha_deg, flow.cl);
  if (!flow.converged()) {
    warn(source, flow);
  } else {
    write_with_fields(outputs, input, fields_of(flow));
    files = outputs.files();
    if (!run.cp_plot.empty()) {
      draw_plot(cp_plot(without_openings(input.frozen, options), options.farfield,
                        pressure_coefficients(flow), caption, "--cp-plot"),
                run.cp_plot);
      files.push_back(run.cp_plot);
    }
  }

  if (!run.history.empty()) {
    write_residuals(flow.history, flow.converged() ? caption : "not converged", run.history);
    if (flow.converged()) files.push_back(run.history);
  }

  Report report;
  add_flow_mesh(report, source, "euler", input.frozen);
  add_flow_figures(report, flow);
  Json gradients;
  if (run.gradient && flow.converged()) gradients = gradients_json(living, *input.living, run.conditions);
  if (!gradients.is_null()) {
    report.data("gradient", gradients);
    report.line("gradient of CD", gradients["cd"].dump());
    report.line("gradient of CL", gradients["cl"].dump());
  }
  if (flow.converged()) add_output_figures(report, files);
  report.print(run.json);
  const bool interrupted = run.gradient && flow.converged() && gradients.is_null();
  return interrupted ? Status::limit : status_of(flow);
}

Status run_series(const EulerRun& run, StartMesh start) {
  require_mach(run);
  if (run.gradient)
    throw Error(ErrorCode::argument, "--gradient", "given with --series, expected a single flow");
  const std::vector<CstAirfoil> airfoils = read_series(run.series);
  std::vector<Domain> domains;
  for (std::size_t i = 0; i < airfoils.size(); ++i) {
    try {
      domains.push_back(with_new_airfoil(start, {}, airfoils[i]));
      validate(domains.back());
    } catch (const Error& error) {
      throw Error(error.code(), run.series + ", airfoil " + std::to_string(i + 1), error.what());
    }
  }
  InterruptObserver observer;
  FlowOptions options = options_of(run);
  options.observer = &observer;
  LivingFlow living(options);
  Comparison comparison(run.compare, start.mesh.options(), run.conditions, options);
  Json designs = Json::array();
  Status worst = Status::done;
  int factorisations = 0, not_found = 0;
  double seconds = 0.0;
  for (const Domain& domain : domains) {
    const RemodelResult step = remodel(start.mesh, domain, {.observer = &observer});
    if (step.stopped == Stopped::interrupted) {
      worst = Status::limit;
      break;
    }
    const FlowResult flow = living.solve(start.mesh, run.conditions);
    Json entry = to_json(flow);
    entry["full_adjustment"] = step.full_adjustment;
    comparison.add(domain, entry);
    designs.push_back(std::move(entry));
    factorisations += flow.factorisations;
    not_found += !flow.converged();
    seconds += flow.seconds;
    if (flow.status == FlowStatus::interrupted || flow.status == FlowStatus::memory) {
      worst = Status::limit;
      break;
    }
    if (!flow.converged() && worst == Status::done) worst = status_of(flow);
  }
  Report report;
  report.figure("mesh", "mesh", start.source);
  report.data("model", "euler");
  report.figure("flows", "flows", designs.size());
  report.figure("not_converged", "flows that were not found", not_found);
  report.figure("factorisations", "factorisations", factorisations);
  report.figure("seconds", "solving", seconds, "seconds");
  for (std::size_t i = 0; i < designs.size(); ++i)
    report.line("design " + std::to_string(i + 1),
                "CL " + designs[i]["cl"].dump() + ", CD " + designs[i]["cd"].dump() + ", " +
                    designs[i]["warm"].get<std::string>() + ", " + designs[i]["status"].get<std::string>());
  report.data("designs", std::move(designs));
  report.print(run.json);
  return worst;
}

}  // namespace remodel::app
