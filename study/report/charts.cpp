// The paper's figures 2 to 4 and A11 to A37 as SVG: one panel for each sigma, the figure over I, one line for
// each D, solid for our values and dashed for the paper's; and surplus against lost triangles.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "study/report/names.h"
#include "study/report/svg.h"
#include "study/study_report.h"

namespace remodel {

namespace {

using report::short_number;
using report::Svg;

// The size of a panel and its margins, in pixels.
constexpr struct {
  double width = 250, height = 210, left = 58, top = 44, gap = 22, bottom = 44, legend = 26;
} panel_layout;
// Four hues that can be told apart with any colour vision (Okabe and Ito 2008).
constexpr std::array<const char*, 4> line_colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};

struct ChartSeries {
  std::size_t color = 0;
  bool dashed = false;  // the paper's
  bool joined = true;
  std::vector<Point> points;
};
struct ChartPanel {
  std::string title;
  std::vector<ChartSeries> series;
};
struct LegendEntry {
  std::string label;
  std::size_t color;
  bool dashed;
  bool joined = true;
};

// About five round numbers that span the values.
std::vector<double> round_ticks(double low, double high) {
  if (!(high > low)) high = low + 1.0;
  const double raw = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (step < raw) step = factor * power;
  std::vector<double> ticks;
  for (double k = std::floor(low / step); k * step < high + step; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

// Positions along an axis from low to high, 0 to 1, with the numbers to be written.
struct ChartAxis {
  std::string title;
  std::vector<double> ticks = {};
  double low = 0.0, high = 1.0;
  bool logarithmic = false;

  double at(double value) const {
    const auto scale = [&](double v) { return logarithmic ? std::log(v) : v; };
    return (scale(value) - scale(low)) / (scale(high) - scale(low));
  }
};

struct Extent {
  double low = HUGE_VAL, high = -HUGE_VAL;
};

template <typename Get>
Extent extent_of(const std::vector<ChartPanel>& panels, Get get) {
  Extent extent;
  for (const ChartPanel& panel : panels)
    for (const ChartSeries& series : panel.series)
      for (const Point p : series.points)
        extent = {std::min(extent.low, get(p)), std::max(extent.high, get(p))};
  return extent.low <= extent.high ? extent : Extent{0.0, 1.0};
}

ChartAxis vertical_axis(const std::vector<ChartPanel>& panels, const std::string& title) {
  const Extent extent = extent_of(panels, [](Point p) { return p.y; });
  ChartAxis axis{.title = title, .ticks = round_ticks(extent.low, extent.high)};
  axis.low = axis.ticks.front();
  axis.high = axis.ticks.back();
  return axis;
}

// A logarithmic axis with a margin on both sides of the values.
ChartAxis horizontal_axis(const std::string& title, const std::vector<double>& ticks, Extent extent) {
  ChartAxis axis{
      .title = title, .ticks = {}, .low = extent.low / 1.15, .high = extent.high * 1.15, .logarithmic = true};
  for (const double tick : ticks)
    if (tick >= axis.low && tick <= axis.high) axis.ticks.push_back(tick);
  return axis;
}

void draw_axes(Svg& svg, Point corner, const ChartPanel& panel, const ChartAxis& x, const ChartAxis& y,
               bool labels) {
  svg.text({corner.x + panel_layout.width / 2, corner.y - 8}, panel.title,
           "text-anchor='middle' font-weight='600'");
  for (const double tick : y.ticks) {
    const double at = corner.y + panel_layout.height * (1.0 - y.at(tick));
    svg.line({corner.x, at}, {corner.x + panel_layout.width, at},
             "stroke='currentColor' stroke-opacity='.15'");
    if (labels)
      svg.text({corner.x - 6, at + 4}, short_number(std::round(tick * 1e6) / 1e6), "text-anchor='end'");
  }
  for (const double tick : x.ticks) {
    const double at = corner.x + panel_layout.width * x.at(tick);
    svg.line({at, corner.y + panel_layout.height}, {at, corner.y + panel_layout.height + 4},
             "stroke='currentColor'");
    svg.text({at, corner.y + panel_layout.height + 17}, short_number(std::round(tick * 1e6) / 1e6),
             "text-anchor='middle'");
  }
  svg.line({corner.x, corner.y + panel_layout.height},
           {corner.x + panel_layout.width, corner.y + panel_layout.height}, "stroke='currentColor'");
  svg.text({corner.x + panel_layout.width / 2, corner.y + panel_layout.height + 34}, x.title,
           "text-anchor='middle'");
}

void draw_point(Svg& svg, Point at, const std::string& color, bool hollow) {
  svg.circle(at, 2.6, hollow ? "fill='none' stroke='" + color + "'" : "fill='" + color + "'");
}

void draw_series(Svg& svg, Point corner, const ChartSeries& series, const ChartAxis& x, const ChartAxis& y) {
  std::vector<Point> pixels;
  for (const Point p : series.points)
    pixels.push_back(
        {corner.x + panel_layout.width * x.at(p.x), corner.y + panel_layout.height * (1.0 - y.at(p.y))});
  const std::string color = line_colors[series.color % line_colors.size()];
  if (series.joined)
    svg.polyline(pixels, "fill='none' stroke='" + color + "' stroke-width='1.6'" +
                             (series.dashed ? " stroke-dasharray='5 4' stroke-opacity='.8'" : ""));
  for (const Point p : pixels) draw_point(svg, p, color, series.dashed);
}

std::string draw_chart(const std::string& title, const std::vector<ChartPanel>& panels, const ChartAxis& x,
                       const ChartAxis& y, const std::vector<LegendEntry>& entries) {
  const auto count = static_cast<double>(panels.size());
  Svg svg(panel_layout.left + count * (panel_layout.width + panel_layout.gap),
          panel_layout.top + panel_layout.height + panel_layout.bottom + panel_layout.legend, title);
  svg.text({12, panel_layout.top + panel_layout.height / 2}, y.title,
           "text-anchor='middle' transform='rotate(-90 12 " +
               report::pixels(panel_layout.top + panel_layout.height / 2) + ")'");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Point corner{panel_layout.left + static_cast<double>(i) * (panel_layout.width + panel_layout.gap),
                       panel_layout.top};
    draw_axes(svg, corner, panels[i], x, y, i == 0);
    for (const ChartSeries& series : panels[i].series) draw_series(svg, corner, series, x, y);
  }
  double at = panel_layout.left;
  for (const LegendEntry& entry : entries) {
    const double height =
        panel_layout.top + panel_layout.height + panel_layout.bottom + panel_layout.legend - 10;
    const std::string color = line_colors[entry.color % line_colors.size()];
    if (entry.joined)
      svg.line({at, height - 4}, {at + 22, height - 4},
               "stroke='" + color + "' stroke-width='2'" + (entry.dashed ? " stroke-dasharray='5 4'" : ""));
    else
      draw_point(svg, {at + 16, height - 4}, color, entry.dashed);
    svg.text({at + 27, height}, entry.label);
    at += 40 + 7.0 * static_cast<double>(entry.label.size());
  }
  return svg.finish();
}

struct ChartQuantity {
  StudyFigure figure;
  const char* name;
  const char* title;
  const char* axis;
};
constexpr std::array quantities = {
    ChartQuantity{StudyFigure::preserved_percent, "preservation", "Element preservation", "preservation, %"},
    ChartQuantity{StudyFigure::surplus_percent, "surplus", "Element surplus", "surplus, %"},
    ChartQuantity{StudyFigure::speedup, "speed-up", "Speed-up", "speed-up"}};

using ChartRows = std::vector<const StudyRow*>;

template <typename Key>
std::set<Key> values_of(const ChartRows& rows, Key StudyCase::*member) {
  std::set<Key> values;
  for (const StudyRow* row : rows) values.insert(row->at.*member);
  return values;
}

ChartPanel panel_over_points(const ChartRows& rows, double sigma, StudyFigure figure,
                             const std::set<double>& distances) {
  ChartPanel panel{"σ = " + short_number(sigma), {}};
  std::size_t color = 0;
  for (const double distance : distances) {
    ChartSeries ours{.color = color, .dashed = false, .joined = true, .points = {}};
    ChartSeries papers{.color = color, .dashed = true, .joined = true, .points = {}};
    for (const StudyRow* row : rows) {
      if (row->at.sigma != sigma || row->at.distance != distance) continue;
      const double at = row->at.points;
      if (const double mean = (*row)[figure].mean; !std::isnan(mean)) ours.points.push_back({at, mean});
      if (const PaperRow* paper = paper_row(row->at))
        papers.points.push_back({at, paper->figures[static_cast<std::size_t>(figure)]});
    }
    panel.series.push_back(std::move(papers));
    panel.series.push_back(std::move(ours));
    ++color;
  }
  return panel;
}

StudySvg chart_over_points(const ChartRows& rows, const ChartQuantity& quantity, const std::string& name) {
  const std::set<double> distances = values_of(rows, &StudyCase::distance);
  const std::set<int> points = values_of(rows, &StudyCase::points);
  std::vector<ChartPanel> panels;
  for (const double sigma : values_of(rows, &StudyCase::sigma))
    panels.push_back(panel_over_points(rows, sigma, quantity.figure, distances));
  std::vector<LegendEntry> entries;
  for (const double distance : distances)
    entries.push_back({"D = " + short_number(distance), entries.size(), false});
  entries.push_back({"dashed: the paper", 0, true});
  const ChartAxis x =
      horizontal_axis("I", {points.begin(), points.end()},
                      {static_cast<double>(*points.begin()), static_cast<double>(*points.rbegin())});
  const ChartAxis y = vertical_axis(panels, quantity.axis);
  const std::string title = std::string(quantity.title) + ", " + report::title_of(rows.front()->at.airfoil) +
                            ", " + rows.front()->strategy;
  return {name, title, draw_chart(title, panels, x, y, entries)};
}

ChartPanel panel_of_losses(const ChartRows& rows, double sigma, const std::vector<std::string>& strategies) {
  ChartPanel panel{"σ = " + short_number(sigma), {}};
  for (std::size_t k = 0; k < strategies.size(); ++k) {
    ChartSeries series{.color = k + 1, .dashed = false, .joined = false, .points = {}};
    for (const StudyRow* row : rows) {
      if (row->at.sigma != sigma || row->strategy != strategies[k]) continue;
      const double lost = (*row)[StudyFigure::lost].mean, surplus = (*row)[StudyFigure::surplus_percent].mean;
      if (lost > 0.0 && !std::isnan(surplus)) series.points.push_back({lost, surplus});
    }
    panel.series.push_back(std::move(series));
  }
  ChartSeries papers{.color = 0, .dashed = true, .joined = false, .points = {}};
  for (const StudyRow* row : rows) {
    const PaperRow* paper =
        row->at.sigma == sigma && row->strategy == strategies.front() ? paper_row(row->at) : nullptr;
    if (paper != nullptr) papers.points.push_back({report::papers_lost(*paper), paper->figures[5]});
  }
  panel.series.push_back(std::move(papers));
  return panel;
}

StudySvg chart_of_losses(const ChartRows& rows, const std::vector<std::string>& strategies,
                         const std::string& name) {
  std::vector<ChartPanel> panels;
  for (const double sigma : values_of(rows, &StudyCase::sigma))
    panels.push_back(panel_of_losses(rows, sigma, strategies));
  std::vector<LegendEntry> entries = {{"the paper", 0, true, false}};
  for (const std::string& strategy : strategies) entries.push_back({strategy, entries.size(), false, false});
  const ChartAxis x =
      horizontal_axis("triangles lost per step", {20, 50, 100, 200, 500, 1000, 2000, 5000, 10000},
                      extent_of(panels, [](Point p) { return p.x; }));
  const ChartAxis y = vertical_axis(panels, "surplus, %");
  const std::string title = "Surplus against lost triangles, " + report::title_of(rows.front()->at.airfoil);
  return {name, title, draw_chart(title, panels, x, y, entries)};
}

}  // namespace

std::vector<StudySvg> study_charts(const StudyContents& study) {
  std::vector<StudySvg> charts;
  std::map<std::string, std::map<std::string, ChartRows>> groups;  // by airfoil, by strategy
  for (const StudyRow& row : study.rows) groups[row.at.airfoil][row.strategy].push_back(&row);
  for (const StudyOutline& airfoil : study.airfoils) {
    const auto found = groups.find(airfoil.name);
    if (found == groups.end()) continue;
    const std::string file = report::file_name_of(airfoil.name);
    std::vector<std::string> strategies;
    ChartRows all;
    for (const auto& [strategy, rows] : found->second) {
      for (const ChartQuantity& quantity : quantities)
        charts.push_back(chart_over_points(
            rows, quantity, file + "-" + report::file_name_of(strategy) + "-" + quantity.name));
      strategies.push_back(strategy);
      all.insert(all.end(), rows.begin(), rows.end());
    }
    charts.push_back(chart_of_losses(all, strategies, file + "-lost"));
  }
  return charts;
}

}  // namespace remodel
