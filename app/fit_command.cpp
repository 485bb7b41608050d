// remodel fit AIRFOIL [-o FILE.json]: CST coefficients, and how well they fit.

#include <filesystem>
#include <memory>
#include <optional>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "meshing_options.h"
#include "outputs.h"
#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "shape_input.h"

namespace remodel::app {
namespace {

struct FitCommand {
  std::string shape;
  std::string output;
  FitOptions fit;
  bool json = false;
};

void require_possible(const FitCommand& command) {
  if (command.output.empty()) return;
  require_writable_as(command.output, {".json"});
  require_no_input(command.output, {command.shape});
}

void add_extreme(Report& report, const std::string& key, const Extreme& extreme) {
  report.data(key, {{"value", extreme.value}, {"at", extreme.at}});
  report.line("largest " + key, Json(extreme.value).dump() + " chords at x = " + Json(extreme.at).dump());
}

// Where the file has the section: --place puts it there again.
void add_frame_line(Report& report, const AirfoilFrame& frame) {
  const auto text = [](double value) { return Json(value + 0.0).dump(); };
  report.line("place in the file", text(frame.chord) + "," + text(-frame.incidence_deg()) + "," +
                                       text(frame.nose.x) + "," + text(frame.nose.y));
}

Status run(const FitCommand& command) {
  require_possible(command);
  require_coordinate_file({command.shape}, command.fit);
  const CstFit fit = fit_shape(command.shape, command.fit);
  const bool apart = surfaces_apart(fit.airfoil);
  if (!command.output.empty()) {
    write_text_atomically(command.output, airfoil_to_json(fit.airfoil) + "\n");
  }
  Report report;
  report.figure("shape", "shape", command.shape);
  report.figure("degree", "Bernstein degree", fit.airfoil.degree());
  report.figure("upper", "upper coefficients", fit.airfoil.upper);
  report.figure("lower", "lower coefficients", fit.airfoil.lower);
  report.figure("te_upper", "trailing edge of the upper surface", fit.airfoil.te_upper, "chords");
  report.figure("te_lower", "trailing edge of the lower surface", fit.airfoil.te_lower, "chords");
  report.figure("trailing_edge_gap", "gap of the file's trailing edge", fit.gap, "chords");
  report.data("frame", frame_json(fit.frame));
  add_frame_line(report, fit.frame);
  report.figure("max_error", "largest fit error", fit.max_error, "chords");
  report.figure("rms_error", "RMS fit error", fit.rms_error, "chords");
  add_extreme(report, "thickness", max_thickness(fit.airfoil));
  add_extreme(report, "camber", max_camber(fit.airfoil));
  report.figure("surfaces_apart", "surfaces apart", apart);
  if (!command.output.empty()) add_output_figures(report, {command.output});
  report.print(command.json);
  return apart ? Status::done : Status::answer_is_no;
}

}  // namespace

void add_fit_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<FitCommand>();
  CLI::App& app = add_command(program, "fit",
                              "Fits CST coefficients to an airfoil; exit status 1 if the fit crosses itself",
                              command, action);
  add_text(app, {"airfoil", "AIRFOIL", "", shape_help}, Presence::required, command->shape);
  add_text(app, {"-o,--output", "FILE", "", "File to write the coefficients to: .json, a SHAPE itself"},
           Presence::optional, command->output);
  add_fit_options(app, command->fit);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
