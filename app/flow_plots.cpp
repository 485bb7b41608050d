#include "flow_plots.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {

std::string flow_caption(double mach, double alpha_deg, double cl) {
  char caption[100];
  std::snprintf(caption, sizeof caption, "M %.4g, \u03b1 = %.4g\u00b0, CL = %.4f", mach, alpha_deg, cl);
  return caption;
}

Plot cp_plot(const FrozenMesh& mesh, const std::string& farfield, std::span<const double> cp,
             const std::string& caption, const std::string& option) {
  Plot plot{.x = {"x/c"}, .y = {.label = "Cp", .reversed = true}, .caption = caption};
  const auto point_of = [&](std::uint32_t v) { return Point{mesh.points[v].x, cp[v]}; };
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    if (boundary.name == farfield || boundary.edges.empty()) continue;
    // A curve for each body of that name.
    std::uint32_t last = 0;
    for (const auto& [from, to] : boundary.edges) {
      const bool first = &from == &boundary.edges.front()[0];
      if (first || from != last) plot.curves.push_back({first ? boundary.name : "", {point_of(from)}});
      plot.curves.back().points.push_back(point_of(to));
      last = to;
    }
  }
  if (plot.curves.empty()) throw Error(ErrorCode::argument, option, "found no body, expected one");
  return plot;
}

void write_residuals(std::span<const double> residuals, const std::string& caption, const std::string& file) {
  if (std::filesystem::path(file).extension() == ".csv") {
    std::string table = "step,residual\n";
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      char line[64];
      std::snprintf(line, sizeof line, "%zu,%.17g\n", i, residuals[i]);
      table += line;
    }
    write_text_atomically(file, table);
    return;
  }
  Plot plot{.x = {"step"}, .y = {.label = "residual", .logarithmic = true}, .caption = caption};
  plot.curves.push_back({});
  for (std::size_t i = 0; i < residuals.size(); ++i)
    plot.curves.back().points.push_back({static_cast<double>(i), std::fmax(residuals[i], 1e-16)});
  draw_plot(plot, file);
}

}  // namespace remodel::app
