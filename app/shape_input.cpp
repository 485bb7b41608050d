#include "shape_input.h"

#include <cstdio>
#include <filesystem>

#include "number_text.h"
#include "remodel/shape_files.h"

namespace remodel::app {
namespace {

constexpr std::string_view naca = "naca:";

CstFit fit_file(const std::string& file, const FitOptions& options) {
  const CstFit fit = fit_cst_apart(read_airfoil(file), options.degree, options.trailing_edge());
  if (fit.airfoil.degree() != options.degree)
    std::fprintf(stderr, "remodel: %s: the fit of degree %d crosses itself, that of degree %d is taken\n",
                 file.c_str(), options.degree, fit.airfoil.degree());
  return fit;
}

}  // namespace

bool is_coordinate_file(const std::string& shape) {
  if (shape.starts_with(naca) || std::filesystem::path(shape).extension() == ".json") return false;
  std::error_code ignored;
  return shape.find_first_of("/.") != std::string::npos ||
         (std::filesystem::exists(shape, ignored) && !std::filesystem::is_directory(shape, ignored));
}

CstFit fit_shape(const std::string& shape, const FitOptions& options) {
  if (is_coordinate_file(shape)) return fit_file(shape, options);
  if (shape.starts_with(naca)) return fit_cst(naca_airfoil(shape.substr(naca.size())), options.degree);
  const CstAirfoil airfoil = load_airfoil(shape, options.degree);
  for (const CatalogueEntry& entry : airfoil_catalogue())
    if (entry.name == shape) return {airfoil, entry.fit_max_error, entry.fit_rms_error};
  return {.airfoil = airfoil};
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
                    {"te_lower", fit.airfoil.te_lower}});
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
