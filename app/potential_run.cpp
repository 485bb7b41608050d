#include "potential_run.h"

#include <optional>

#include "figures.h"
#include "flow_files.h"
#include "remodel/flow_plots.h"
#include "remodel/plot.h"
#include "report.h"
#include "timing.h"

namespace remodel::app {
namespace {

void add_flow_figures(Report& report, const PotentialFlow& flow) {
  const std::string mark = flow.lift_determined ? "" : "(not determined)";
  report.figure("cl", "CL", flow.lift, mark);
  report.figure("cd", "CD by pressure, an error", flow.drag_by_pressure);
  report.figure("cm", "CM", flow.moment, mark);
  report.figure("cl_by_pressure", "CL by pressure", flow.lift_by_pressure, mark);
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
                      {"circulation", body.circulation},
                      {"cl", body.lift},
                      {"cd", body.drag},
                      {"cm", body.moment}});
    const char* const edge = body.trailing_edge ? "" : "; no trailing edge, so no circulation";
    report.line("body " + body.name, "CL " + Json(body.lift).dump() + " by pressure" + edge);
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
                   flow_caption(flow.mach, flow.alpha_deg, flow.lift), "--cp-plot");
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
