#include "remodel/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

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
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
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
      set_color(cairo, curve_colors[k % curve_colors.size()]);
      cairo_stroke(cairo);
      // A line through few points says little of where they are, and through one nothing at all.
      constexpr std::size_t few = 3;
      if (points.size() > few) continue;
      for (const Point p : points) {
        cairo_arc(cairo, x_.pixel(p.x), y_.pixel(p.y), 6.0 * unit_, 0.0, 2.0 * std::numbers::pi);
        cairo_fill(cairo);
      }
    }
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

  // At the right, below the upper edge.
  void names(cairo_t* cairo) const {
    double y = y_.to + 30.0 * unit_;
    for (std::size_t k = 0; k < plot_.curves.size(); ++k) {
      const std::string& name = plot_.curves[k].name;
      if (name.empty()) continue;
      const double left = x_.to - text_width(cairo, name) - 20.0 * unit_;
      put_text(cairo, left, y, name);
      set_color(cairo, curve_colors[k % curve_colors.size()]);
      cairo_set_line_width(cairo, 3.0 * unit_);
      line(cairo, left - 40.0 * unit_, y - 6.0 * unit_, left - 10.0 * unit_, y - 6.0 * unit_);
      y += 28.0 * unit_;
    }
  }

  const Plot& plot_;
  Scale x_, y_;
  double unit_ = 1.0;  // pixels of a line one thick
};

}  // namespace

void draw_plot(const Plot& plot, const std::filesystem::path& file) {
  const bool svg = draw_detail::is_svg(file);
  const PlotPainter painter(plot);
  const auto paint = [&](cairo_t* cairo) { painter.paint(cairo); };
  const auto bytes = svg ? draw_detail::svg_bytes(file, painter.width(), painter.height(), paint)
                         : draw_detail::png_bytes(file, painter.width(), painter.height(), paint);
  write_text_atomically(file, bytes);
}

}  // namespace remodel
