#include "remodel/flow_plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "aero/boundary_pieces.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {

std::string flow_caption(double mach, double alpha_deg, double cl) {
  char caption[100];
  if (std::isnan(cl)) {
    std::snprintf(caption, sizeof caption, "M %.4g, \u03b1 = %.4g\u00b0", mach, alpha_deg);
    return caption;
  }
  std::snprintf(caption, sizeof caption, "M %.4g, \u03b1 = %.4g\u00b0, CL = %.4f", mach, alpha_deg, cl);
  return caption;
}

std::string duct_caption(double mach) {
  char caption[40];
  std::snprintf(caption, sizeof caption, "M %.4g", mach);
  return caption;
}

FrozenMesh without_boundaries(FrozenMesh mesh, std::span<const std::string> names) {
  std::erase_if(mesh.boundaries, [&](const FrozenBoundary& boundary) {
    return std::find(names.begin(), names.end(), boundary.name) != names.end();
  });
  return mesh;
}

namespace {

// Adds a curve of the values along each piece of a boundary but the far field.
Plot along_bodies(Plot plot, const FrozenMesh& mesh, const std::vector<std::string>& farfield,
                  std::span<const double> values, const std::string& option) {
  const auto point_of = [&](std::uint32_t v) { return Point{mesh.points[v].x, values[v]}; };
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    const bool is_far = std::find(farfield.begin(), farfield.end(), boundary.name) != farfield.end();
    if (is_far || boundary.edges.empty()) continue;
    const auto pieces = boundary_pieces(boundary);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      PlotCurve& curve = plot.curves.emplace_back();
      curve.name = pieces.size() == 1 ? boundary.name : boundary.name + " " + std::to_string(i + 1);
      for (const std::uint32_t v : pieces[i]) curve.points.push_back(point_of(v));
    }
  }
  if (plot.curves.empty()) throw Error(ErrorCode::argument, option, "found no body, expected one");
  return plot;
}

}  // namespace

Plot cp_plot(const FrozenMesh& mesh, const std::vector<std::string>& farfield, std::span<const double> cp,
             const std::string& caption, const std::string& option) {
  return along_bodies({.x = {"x"}, .y = {.label = "Cp", .reversed = true}, .caption = caption}, mesh,
                      farfield, cp, option);
}

Plot cf_plot(const FrozenMesh& mesh, const std::vector<std::string>& farfield, std::span<const double> cf,
             const std::string& caption, const std::string& option) {
  return along_bodies({.x = {"x"}, .y = {.label = "Cf"}, .caption = caption}, mesh, farfield, cf, option);
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

}  // namespace remodel
