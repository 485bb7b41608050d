// The paper's figures A1 to A10: airfoils as outlines, with thickness and camber.

#include <cmath>

#include "study/report/names.h"
#include "study/report/svg.h"
#include "study/study_report.h"

namespace remodel {

namespace {

using report::fixed;
using report::Svg;

constexpr double outline_scale = 420, outline_margin = 14;  // pixels per chord, pixels
constexpr int outline_stations = 200;

std::string extreme_text(const char* what, const Extreme& extreme) {
  if (std::abs(extreme.value) < 5e-5) return std::string(what) + " 0";
  return std::string(what) + ' ' + fixed(100.0 * extreme.value, 1) + " % at " + fixed(100.0 * extreme.at, 1) +
         " % of the chord";
}

StudySvg outline(const StudyOutline& airfoil, const CstAirfoil& design) {
  std::vector<Point> points, middle;
  double low = 0.0, high = 0.0;
  for (int i = 0; i <= outline_stations; ++i) {
    const double t = static_cast<double>(i) / outline_stations;
    points.push_back(design.at(t));
    low = std::min(low, points.back().y);
    high = std::max(high, points.back().y);
    if (2 * i > outline_stations) continue;
    const Point other = design.at(1.0 - t);
    middle.push_back({other.x, (points.back().y + other.y) / 2});
  }
  const double height = (high - low) * outline_scale + 2 * outline_margin;
  const auto pixel = [&](Point& p) {
    p = {outline_margin + outline_scale * p.x, outline_margin + outline_scale * (high - p.y)};
  };
  for (Point& p : points) pixel(p);
  for (Point& p : middle) pixel(p);
  const std::string words =
      extreme_text("thickness", max_thickness(design)) + ", " + extreme_text("camber", max_camber(design));
  const std::string title = airfoil.title + ": " + words;
  Svg svg(outline_scale + 2 * outline_margin, height, title);
  svg.polyline(points, "fill='currentColor' fill-opacity='.07' stroke='currentColor' stroke-width='1.4'");
  svg.polyline(middle, "fill='none' stroke='#0072b2' stroke-dasharray='5 4'");
  return {"airfoil-" + report::file_name_of(airfoil.name), title, svg.finish()};
}

}  // namespace

std::vector<StudySvg> study_airfoil_figures(const StudyContents& study) {
  std::vector<StudySvg> figures;
  for (const StudyOutline& airfoil : study.airfoils)
    if (airfoil.design) figures.push_back(outline(airfoil, *airfoil.design));
  return figures;
}

}  // namespace remodel
