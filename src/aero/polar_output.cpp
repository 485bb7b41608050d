// Polars as tables and plots.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "aero/table_cell.h"
#include "remodel/polar.h"

namespace remodel {

namespace {

std::string row_of(const PolarCurve& curve, const PolarPoint& point) {
  const double reynolds = curve.model == FlowModel::euler ? PolarPoint::none : curve.reynolds;
  const std::string cells[] = {table_cell(curve.name),
                               table_cell(curve.mach),
                               table_cell(reynolds),
                               point.asked ? "1" : "0",
                               table_cell(point.alpha_deg),
                               table_cell(point.cl),
                               table_cell(point.cd),
                               table_cell(point.cm),
                               table_cell(point.cd_pressure),
                               table_cell(point.cd_friction),
                               table_cell(point.y_plus_max),
                               point.converged ? "1" : "0",
                               point.status ? name_of(*point.status) : "not-looked-for",
                               std::to_string(point.newton_steps),
                               table_cell(point.residual),
                               table_cell(point.reason),
                               table_cell(joined(point.warnings))};
  std::string row;
  for (const std::string& cell : cells) row += cell + ',';
  row.back() = '\n';
  return row;
}

// What the curves have in common is said in the caption, what differs in their names.
struct PlotNames {
  explicit PlotNames(const std::vector<PolarCurve>& curves) {
    for (const PolarCurve& curve : curves) {
      several_names |= curve.name != curves.front().name;
      several_machs |= curve.mach != curves.front().mach;
    }
  }
  std::string of(const PolarCurve& curve) const {
    std::string name = several_names ? curve.name : "";
    if (several_machs) name += (name.empty() ? "M " : ", M ") + short_number(curve.mach);
    return name;
  }
  std::string in_common(const PolarCurve& curve) const {
    std::string text = several_names ? "" : curve.name;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (!several_machs) add("M " + short_number(curve.mach));
    if (curve.model != FlowModel::euler) add("Re " + short_number(curve.reynolds));
    add(name_of(curve.model));
    if (const auto& at = curve.transition)
      add("transition at " + short_number((*at)[0]) + ", " + short_number((*at)[1]));
    return text;
  }
  static std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }

  bool several_names = false, several_machs = false;
};

std::string lift_text(const LargestLift& lift) {
  char text[100];
  std::snprintf(text, sizeof text, lift.passed ? "CL max %.4g at %.4g\u00b0" : "CL up to %.4g at %.4g\u00b0",
                lift.cl, lift.alpha_deg);
  return text;
}

using Coordinates = std::function<Point(const PolarPoint&)>;

constexpr const char* angle_label = "\u03b1, degrees";

Plot plot_of(const std::vector<PolarCurve>& curves, const PlotNames& names, const std::string& x,
             const std::string& y, const Coordinates& at) {
  constexpr int panel_width = 800;
  Plot plot;
  plot.x.label = x, plot.y.label = y;
  plot.width = panel_width;
  for (const PolarCurve& curve : curves) {
    PlotCurve drawn{.name = names.of(curve), .points = {}, .dots = true};
    for (const PolarPoint& point : curve.points)
      if (point.converged && !std::isnan(point.cl)) drawn.points.push_back(at(point));
    plot.curves.push_back(std::move(drawn));  // also without points: colours are by place
  }
  return plot;
}

}  // namespace

std::string polar_table(const std::vector<PolarCurve>& curves) {
  std::string table =
      "shape,mach,reynolds,asked,alpha_deg,cl,cd,cm,cd_pressure,cd_friction,y_plus_max,converged,status,"
      "newton_steps,residual,reason,warnings\n";
  for (const PolarCurve& curve : curves)
    for (const PolarPoint& point : curve.points) table += row_of(curve, point);
  return table;
}

std::vector<Plot> polar_plots(const std::vector<PolarCurve>& all) {
  std::vector<PolarCurve> curves;
  for (const PolarCurve& curve : all)
    if (largest_lift(curve)) curves.push_back(curve);
  if (curves.empty()) return {};
  const PlotNames names(curves);
  std::vector<Plot> plots;
  plots.push_back(plot_of(curves, names, angle_label, "CL", [](const PolarPoint& p) {
    return Point{p.alpha_deg, p.cl};
  }));
  plots[0].caption = names.in_common(curves.front());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::string& name = plots[0].curves[i].name;
    name += (name.empty() ? "" : ": ") + lift_text(*largest_lift(curves[i]));
  }
  plots.push_back(plot_of(curves, names, "CD", "CL", [](const PolarPoint& p) { return Point{p.cd, p.cl}; }));
  plots.push_back(plot_of(curves, names, angle_label, "CM", [](const PolarPoint& p) {
    return Point{p.alpha_deg, p.cm};
  }));
  // Without friction the drag of a flow without shocks should be 0, and the ratio means nothing.
  if (curves.front().model != FlowModel::euler)
    plots.push_back(plot_of(curves, names, angle_label, "CL / CD", [](const PolarPoint& p) {
      return Point{p.alpha_deg, p.cl / p.cd};
    }));
  return plots;
}

}  // namespace remodel
