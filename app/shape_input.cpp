#include "shape_input.h"

#include <algorithm>

#include "number_text.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/shape_files.h"
#include "warnings.h"

namespace remodel::app {

CstFit fit_shape(const std::string& shape, const FitOptions& options) {
  const CstFit fit = load_fit(shape, options.degree, options.trailing_edge());
  warn(fit.warnings);
  return fit;
}

void require_coordinate_file(const std::vector<std::string>& shapes, const FitOptions& options) {
  if (!options.close_trailing_edge) return;
  // What comes through a pipe is not known before it is read.
  const auto may_be_one = [](const std::string& shape) {
    return is_pipe(shape) || is_coordinate_file(shape);
  };
  if (std::any_of(shapes.begin(), shapes.end(), may_be_one)) return;
  throw Error(ErrorCode::argument, "--close-trailing-edge",
              shapes.empty() ? "given without a shape, expected a coordinate file"
                             : "given for '" + shapes.front() + "', expected for coordinate files");
}

Json frame_json(const AirfoilFrame& frame) {
  const Point moved = -1.0 * frame.nose;
  return {{"turned_deg", frame.incidence_deg()},
          {"sheared", frame.shear},
          {"scaled", 1.0 / frame.chord},
          {"moved", {moved.x + 0.0, moved.y + 0.0}},
          {"closed", frame.closed},
          {"place", {frame.chord, -frame.incidence_deg() + 0.0, frame.nose.x, frame.nose.y}}};
}

CstFit fit_shape(const std::string& shape, const FitOptions& options, std::vector<ShapeFit>& fits) {
  const CstFit fit = fit_shape(shape, options);
  if (is_coordinate_file(shape)) fits.push_back({shape, fit});
  return fit;
}

void add_fit_figures(Report& report, const std::vector<ShapeFit>& fits) {
  Json list = Json::array();
  for (const auto& [shape, fit] : fits) {
    const double kept = fit.airfoil.te_upper - fit.airfoil.te_lower;
    list.push_back({{"shape", shape},
                    {"degree", fit.airfoil.degree()},
                    {"max_error", fit.max_error},
                    {"rms_error", fit.rms_error},
                    {"trailing_edge_gap", fit.gap},
                    {"te_upper", fit.airfoil.te_upper},
                    {"te_lower", fit.airfoil.te_lower},
                    {"frame", frame_json(fit.frame)}});
    std::string text = "degree " + std::to_string(fit.airfoil.degree()) + ", largest error " +
                       short_text(fit.max_error) + ", rms " + short_text(fit.rms_error) + " chords";
    if (fit.gap != 0.0)
      text += "; the file's trailing edge is open by " + short_text(fit.gap) + " chords, " +
              (kept > 0.0 ? "kept" : "closed");
    report.line("fit of " + shape, text);
  }
  if (!list.empty()) report.data("fits", std::move(list));
}

}  // namespace remodel::app
