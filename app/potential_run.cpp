#include "potential_run.h"

#include <cmath>
#include <optional>

#include "figures.h"
#include "flow_files.h"
#include "flow_report.h"
#include "remodel/flow_plots.h"
#include "remodel/plot.h"
#include "report.h"
#include "timing.h"

namespace remodel::app {
namespace {

void add_flow_figures(Report& report, const PotentialFlow& flow) {
  const auto if_determined = [&](double value) { return flow.lift_determined ? Json(value) : Json(nullptr); };
  const auto figure = [&](const char* key, const char* label, double value) {
    if (flow.lift_determined) return report.figure(key, label, value);
    report.data(key, nullptr);
    report.line(label, not_determined);
  };
  figure("cl", "CL", flow.lift);
  report.figure("cd", "CD by pressure, an error", flow.drag_by_pressure);
  figure("cm", "CM", flow.moment);
  figure("cl_by_pressure", "CL by pressure", flow.lift_by_pressure);
  report.figure("alpha_deg", "angle of attack", flow.alpha_deg, "degrees");
  report.figure("mach", "Mach number", flow.mach);
  report.data("supersonic", flow.supersonic);
  report.data("lift_determined", flow.lift_determined);
  report.data("warnings", flow.warnings);
  report.data("converged", true);
  Json bodies = Json::array();
  for (const BodyFlow& body : flow.bodies) {
    bodies.push_back({{"name", body.name},
                      {"trailing_edge", body.trailing_edge},
                      {"circulation", if_determined(body.circulation)},
                      {"cl", if_determined(body.lift)},
                      {"cd", body.drag},
                      {"cm", if_determined(body.moment)}});
    const char* const edge = body.trailing_edge ? "" : "; no trailing edge, so no circulation";
    const std::string cl = flow.lift_determined ? Json(body.lift).dump() + " by pressure" : not_determined;
    report.line("body " + body.name, "CL " + cl + edge);
  }
  report.data("bodies", bodies);
}

}  // namespace

void run_potential(const PotentialRun& run, const MeshInput& input, const std::string& source,
                   const MeshOutputs& outputs) {
  const Stopwatch watch;
  const PotentialSolver solver(input.frozen, run.options, source);
  const PotentialFlow flow =
      solver.at(run.lift ? solver.alpha_deg_for(*run.lift, run.mach) : run.alpha_deg, run.mach);
  const double seconds = watch.seconds();
  const std::vector<Field> fields = flow.fields();
  std::optional<Plot> plot;
  if (!run.cp_plot.empty()) {
    plot = cp_plot(input.frozen, run.options.farfield, find_field(fields, "cp")->values,
                   flow_caption(flow.mach, flow.alpha_deg, flow.lift_determined ? flow.lift : std::nan("")),
                   "--cp-plot");
  }
  write_with_fields(outputs, input, fields);
  say_flow_left_out(outputs);
  print_warnings(source, flow.warnings);
  std::vector<std::string> files = outputs.files();
  if (plot) {
    draw_plot(*plot, run.cp_plot);
    files.push_back(run.cp_plot);
  }
  Report report;
  add_flow_mesh(report, source, "potential", input.frozen);
  add_flow_figures(report, flow);
  report.figure("seconds", "flow", seconds, "seconds");
  add_output_figures(report, files);
  report.print(run.json);
}

}  // namespace remodel::app
