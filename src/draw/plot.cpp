#include "remodel/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "draw/canvas.h"
#include "draw/field_painter.h"
#include "draw/layout.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {

namespace {

using draw_detail::Color;
using draw_detail::label_of;
using draw_detail::put_text;
using draw_detail::set_color;
using draw_detail::text_width;
using draw_detail::ticks_within;

constexpr std::array<Color, 6> curve_colors = {{{0.12, 0.35, 0.65},
                                                {0.80, 0.25, 0.15},
                                                {0.15, 0.55, 0.30},
                                                {0.55, 0.30, 0.65},
                                                {0.85, 0.55, 0.05},
                                                {0.30, 0.30, 0.30}}};

// The values of an axis as positions on the page; logarithms on a logarithmic axis.
struct Scale {
  PlotAxis axis;
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  double from = 0.0, to = 1.0;  // pixels of low and high

  double position(double value) const { return axis.logarithmic ? std::log10(value) : value; }
  double pixel(double value) const {
    const double t = (position(value) - low) / (high - low);
    return from + (to - from) * (axis.reversed ? 1.0 - t : t);
  }
  void take(double value) {
    if (!std::isfinite(value) || (axis.logarithmic && !(value > 0.0))) {
      throw Error(
          ErrorCode::argument, "plot",
          label_of(value) + " found, a finite value" + (axis.logarithmic ? " above 0" : "") + " expected");
    }
    low = std::min(low, position(value));
    high = std::max(high, position(value));
  }
  // Room beside the curves; a single value lies in the middle.
  void open() {
    const double size = std::max(std::abs(low), std::abs(high));
    const double range = high - low > 1e-12 * size ? high - low : std::max(0.1 * size, 1e-3);
    low -= 0.04 * range;
    high += 0.04 * range;
  }
  std::vector<double> ticks() const {
    std::vector<double> values;
    if (axis.whole) return whole_ticks();
    if (!axis.logarithmic) return ticks_within(low, high);
    // Powers of ten say nothing of an axis that has one or none.
    if (std::floor(high) - std::ceil(low) < 1.0) return ticks_below_a_decade();
    const double step = std::max(1.0, std::ceil((high - low) / 10.0));
    constexpr int most = 30;
    double power = std::ceil(low / step) * step;
    for (int i = 0; i < most && power <= high; ++i, power += step) values.push_back(std::pow(10.0, power));
    return values;
  }
  std::vector<double> whole_ticks() const {
    std::vector<double> values;
    for (const double tick : ticks_within(low, high))
      if (tick == std::round(tick)) values.push_back(tick);
    if (values.empty()) values.push_back(std::round(0.5 * (low + high)));
    return values;
  }
  std::vector<double> ticks_below_a_decade() const {
    return ticks_within(std::pow(10.0, low), std::pow(10.0, high));
  }
};

class PlotPainter {
 public:
  explicit PlotPainter(const Plot& plot) : plot_(plot) {
    constexpr int narrowest = 200, widest = 8000;
    if (plot.width < narrowest || plot.width > widest)
      throw Error(ErrorCode::argument, "width",
                  std::to_string(plot.width) + " found, 200 to 8000 pixels expected");
    unit_ = std::max(0.4, plot.width / 1200.0);
    x_.axis = plot.x;
    y_.axis = plot.y;
    bool any = false;
    for (const PlotCurve& curve : plot.curves) {
      for (const Point p : curve.points) {
        x_.take(p.x);
        y_.take(p.y);
        any = true;
      }
    }
    if (!any) throw Error(ErrorCode::argument, "plot", "no points found, a curve expected");
    x_.open();
    y_.open();
    x_.from = left() * unit_;
    x_.to = width() - 30.0 * unit_;
    y_.from = height() - 80.0 * unit_;
    y_.to = 60.0 * unit_;
  }

  int width() const { return plot_.width; }
  int height() const { return plot_.width * 2 / 3; }

  void paint(cairo_t* cairo) const {
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, 19.0 * unit_);
    x_ticks(cairo);
    y_ticks(cairo);
    curves(cairo);
    frame(cairo);
    labels(cairo);
  }

 private:
  // Room for the numbers at the ticks of the y axis, by how long they are, and its label.
  double left() const {
    constexpr double least = 110.0, label = 50.0, digit = 12.0;
    std::size_t longest = 0;
    for (const double tick : y_.ticks()) longest = std::max(longest, label_of(tick).size());
    return std::max(least, label + digit * static_cast<double>(longest));
  }

  void line(cairo_t* cairo, double x0, double y0, double x1, double y1) const {
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
    cairo_stroke(cairo);
  }

  void begin_grid(cairo_t* cairo) const {
    set_color(cairo, {0.85, 0.85, 0.88});
    cairo_set_line_width(cairo, 0.8 * unit_);
  }

  void x_ticks(cairo_t* cairo) const {
    for (const double tick : x_.ticks()) {
      const double x = x_.pixel(tick);
      begin_grid(cairo);
      line(cairo, x, y_.from, x, y_.to);
      const std::string text = label_of(tick);
      put_text(cairo, x - 0.5 * text_width(cairo, text), y_.from + 26.0 * unit_, text);
    }
  }

  void y_ticks(cairo_t* cairo) const {
    for (const double tick : y_.ticks()) {
      const double y = y_.pixel(tick);
      begin_grid(cairo);
      line(cairo, x_.from, y, x_.to, y);
      const std::string text = label_of(tick);
      put_text(cairo, x_.from - text_width(cairo, text) - 10.0 * unit_, y + 6.0 * unit_, text);
    }
  }

  void curves(cairo_t* cairo) const {
    cairo_set_line_width(cairo, 2.0 * unit_);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (std::size_t k = 0; k < plot_.curves.size(); ++k) {
      const std::vector<Point>& points = plot_.curves[k].points;
      cairo_new_path(cairo);
      for (const Point p : points) cairo_line_to(cairo, x_.pixel(p.x), y_.pixel(p.y));
      begin_curve(cairo, k);
      cairo_stroke(cairo);
      cairo_set_dash(cairo, nullptr, 0, 0.0);
      // A line through few points says little of where they are, and through one nothing at all.
      constexpr std::size_t few = 3;
      if (points.size() > few && !plot_.curves[k].dots) continue;
      const double radius = (points.size() > few ? 4.0 : 6.0) * unit_;
      for (const Point p : points) {
        cairo_arc(cairo, x_.pixel(p.x), y_.pixel(p.y), radius, 0.0, 2.0 * std::numbers::pi);
        cairo_fill(cairo);
      }
    }
  }

  // There are more curves than colours: the next ones are dashed.
  void begin_curve(cairo_t* cairo, std::size_t k) const {
    set_color(cairo, curve_colors[k % curve_colors.size()]);
    const double dash[] = {10.0 * unit_, 5.0 * unit_};
    const bool dashed = k / curve_colors.size() % 2 == 1;
    cairo_set_dash(cairo, dashed ? dash : nullptr, dashed ? 2 : 0, 0.0);
  }

  void frame(cairo_t* cairo) const {
    set_color(cairo, {0.2, 0.2, 0.2});
    cairo_set_line_width(cairo, 1.2 * unit_);
    cairo_rectangle(cairo, x_.from, y_.to, x_.to - x_.from, y_.from - y_.to);
    cairo_stroke(cairo);
  }

  void labels(cairo_t* cairo) const {
    put_text(cairo, x_.from, 36.0 * unit_, plot_.caption);
    put_text(cairo, 0.5 * (x_.from + x_.to - text_width(cairo, plot_.x.label)), y_.from + 58.0 * unit_,
             plot_.x.label);
    cairo_save(cairo);
    cairo_translate(cairo, 30.0 * unit_, 0.5 * (y_.from + y_.to + text_width(cairo, plot_.y.label)));
    cairo_rotate(cairo, -0.5 * std::numbers::pi);
    put_text(cairo, 0.0, 0.0, plot_.y.label);
    cairo_restore(cairo);
    names(cairo);
  }

  struct Legend {
    double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
    bool has(double x, double y) const {
      return x >= left && x <= left + width && y >= top && y <= top + height;
    }
  };

  // In the corner that curves leave free: the upper right one if several do so alike.
  Legend legend(cairo_t* cairo) const {
    Legend legend;
    for (const PlotCurve& curve : plot_.curves) {
      if (curve.name.empty()) continue;
      legend.width = std::max(legend.width, text_width(cairo, curve.name) + 80.0 * unit_);
      legend.height += legend_line * unit_;
    }
    legend.height += 14.0 * unit_;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    Legend best = legend;
    for (const auto& [right, upper] : {std::pair{true, true}, {false, true}, {true, false}, {false, false}}) {
      legend.left = right ? x_.to - legend.width : x_.from;
      legend.top = upper ? y_.to : y_.from - legend.height;
      const std::size_t covered = covered_by(legend);
      if (covered < least) best = legend, least = covered;
    }
    return best;
  }

  // How many places of curves lie below it, a number of them for each piece between two points.
  std::size_t covered_by(const Legend& legend) const {
    constexpr int places = 8;
    std::size_t covered = 0;
    for (const PlotCurve& curve : plot_.curves) {
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Point a = curve.points[i == 0 ? 0 : i - 1], b = curve.points[i];
        const double dx = x_.pixel(b.x) - x_.pixel(a.x), dy = y_.pixel(b.y) - y_.pixel(a.y);
        for (int k = 1; k <= places; ++k)
          covered += legend.has(x_.pixel(a.x) + dx * k / places, y_.pixel(a.y) + dy * k / places);
      }
    }
    return covered;
  }

  void names(cairo_t* cairo) const {
    const Legend place = legend(cairo);
    double y = place.top + 30.0 * unit_;
    for (std::size_t k = 0; k < plot_.curves.size(); ++k) {
      const std::string& name = plot_.curves[k].name;
      if (name.empty()) continue;
      const double left = place.left + 60.0 * unit_;
      put_text(cairo, left, y, name);
      begin_curve(cairo, k);
      cairo_set_line_width(cairo, 3.0 * unit_);
      line(cairo, left - 40.0 * unit_, y - 6.0 * unit_, left - 10.0 * unit_, y - 6.0 * unit_);
      cairo_set_dash(cairo, nullptr, 0, 0.0);
      y += legend_line * unit_;
    }
  }

  static constexpr double legend_line = 28.0;  // its height
  const Plot& plot_;
  Scale x_, y_;
  double unit_ = 1.0;  // pixels of a line one thick
};

}  // namespace

namespace {

void write_picture(const std::filesystem::path& file, int width, int height,
                   const std::function<void(cairo_t*)>& paint) {
  write_text_atomically(file, draw_detail::is_svg(file) ? draw_detail::svg_bytes(file, width, height, paint)
                                                        : draw_detail::png_bytes(file, width, height, paint));
}

}  // namespace

void draw_plot(const Plot& plot, const std::filesystem::path& file) {
  draw_plots({plot}, 1, file);
}

void draw_plots(const std::vector<Plot>& given, int columns, const std::filesystem::path& file) {
  draw_detail::is_svg(file);  // or refuses it
  if (given.empty()) throw Error(ErrorCode::argument, "plots", "found none, expected one or more");
  if (columns < 1)
    throw Error(ErrorCode::argument, "columns", "found " + std::to_string(columns) + ", expected 1 or more");
  std::vector<Plot> plots = given;
  for (Plot& plot : plots) plot.width = given.front().width;
  std::vector<PlotPainter> painters;
  for (const Plot& plot : plots) painters.emplace_back(plot);
  const int count = static_cast<int>(painters.size()), in_a_row = std::min(columns, count);
  const int width = painters.front().width(), height = painters.front().height();
  write_picture(file, in_a_row * width, (count + in_a_row - 1) / in_a_row * height, [&](cairo_t* cairo) {
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    for (int i = 0; i < count; ++i) {
      cairo_save(cairo);
      cairo_translate(cairo, i % in_a_row * width, i / in_a_row * height);
      painters[static_cast<std::size_t>(i)].paint(cairo);
      cairo_restore(cairo);
    }
  });
}

}  // namespace remodel
