#include "draw/layout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "remodel/error.h"

namespace remodel::draw_detail {

Box box_of(const std::vector<Point>& points) {
  Box box{points.front(), points.front()};
  for (const Point p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

namespace {

Box whole_mesh(const FrozenMesh& mesh) {
  if (mesh.points.empty())
    throw Error(ErrorCode::argument, "draw", "an empty mesh found, one with points expected");
  const Box box = box_of(mesh.points);
  const Point size = box.high - box.low;
  const double margin = 0.02 * std::max({size.x, size.y, 1e-30});
  return {box.low - Point{margin, margin}, box.high + Point{margin, margin}};
}

Box checked_window(const std::array<double, 4>& window) {
  const auto [x0, y0, x1, y1] = window;
  const bool finite = std::isfinite(x0) && std::isfinite(y0) && std::isfinite(x1) && std::isfinite(y1);
  if (!finite || !(x0 < x1) || !(y0 < y1)) {
    throw Error(ErrorCode::argument, "window",
                label_of(x0) + "," + label_of(y0) + "," + label_of(x1) + "," + label_of(y1) +
                    " found, x0,y0,x1,y1 with x0 < x1 and y0 < y1 expected");
  }
  return {{x0, y0}, {x1, y1}};
}

}  // namespace

Layout layout_for(const FrozenMesh& mesh, const DrawOptions& options) {
  constexpr int narrowest = 100;
  constexpr int widest = 8000;
  if (options.width < narrowest || options.width > widest) {
    throw Error(ErrorCode::argument, "width",
                std::to_string(options.width) + " found, 100 to 8000 pixels expected");
  }
  if (!(options.line >= 0.1 && options.line <= 10.0))
    throw Error(ErrorCode::argument, "line", label_of(options.line) + " found, 0.1 to 10 expected");
  Layout layout;
  layout.width = options.width;
  layout.window = options.window ? checked_window(*options.window) : whole_mesh(mesh);
  layout.unit = options.line * std::max(0.4, options.width / 1600.0);

  constexpr double strip = 84.0;         // below the plot: two lines
  constexpr double field_strip = 108.0;  // three
  // A window much flatter or taller than a page is seen with what lies above and below, or beside it.
  constexpr double flattest = 0.1;
  constexpr double tallest = 2.0;
  Box& window = layout.window;
  const Point size = window.high - window.low;
  const Point centre = 0.5 * (window.low + window.high);
  const Point half = {0.5 * std::max(size.x, size.y / tallest), 0.5 * std::max(size.y, size.x * flattest)};
  window = {centre - half, centre + half};
  layout.scale = layout.width / (2.0 * half.x);
  layout.plot_height = static_cast<int>(std::lround(2.0 * half.y * layout.scale));
  layout.height =
      layout.plot_height + static_cast<int>(std::lround((options.field ? field_strip : strip) * layout.unit));
  return layout;
}

void set_color(cairo_t* cairo, const Color& color, double opacity) {
  cairo_set_source_rgba(cairo, color.red, color.green, color.blue, opacity);
}

void add_polygon(cairo_t* cairo, const Layout& layout, const std::vector<Point>& polygon) {
  cairo_new_sub_path(cairo);  // otherwise the first line starts where the last polygon did
  for (const Point p : polygon) {
    const Point q = layout.pixel(p);
    cairo_line_to(cairo, q.x, q.y);
  }
  cairo_close_path(cairo);
}

void add_segment(cairo_t* cairo, const Layout& layout, Point a, Point b, const Box& box) {
  const auto part = clip_segment(a, b, box);
  if (!part) return;
  const Point from = layout.pixel(part->first);
  const Point to = layout.pixel(part->second);
  cairo_move_to(cairo, from.x, from.y);
  cairo_line_to(cairo, to.x, to.y);
}

double put_text(cairo_t* cairo, double x, double baseline, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  cairo_move_to(cairo, x, baseline);
  cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
  cairo_show_text(cairo, text.c_str());
  cairo_new_path(cairo);
  return x + extents.x_advance;
}

double text_width(cairo_t* cairo, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  return extents.x_advance;
}

void fill_path(cairo_t* cairo, Seams seams) {
  if (seams == Seams::fill) {
    cairo_fill_preserve(cairo);
    cairo_stroke(cairo);
  } else {
    cairo_fill(cairo);
  }
}

}  // namespace remodel::draw_detail
