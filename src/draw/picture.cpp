#include "draw/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "remodel/error.h"

namespace remodel::draw_detail {

namespace {

constexpr std::size_t color_levels = 64;  // more cannot be told apart; one path a level keeps files small

constexpr std::array<Color, 6> boundary_colors = {{{0.84, 0.15, 0.16},
                                                   {0.10, 0.10, 0.10},
                                                   {0.89, 0.47, 0.76},
                                                   {1.00, 0.50, 0.05},
                                                   {0.12, 0.47, 0.71},
                                                   {0.55, 0.34, 0.29}}};
const Color& boundary_color(std::size_t k) {
  return boundary_colors[k % boundary_colors.size()];
}

// Edges between large cells are lines, those between cells of a few pixels fade away: drawn in full,
// they would leave nothing of the colours.
double edge_strength(double side) {
  constexpr double vanish = 3.0;
  constexpr double full = 24.0;
  return std::clamp(std::log(side / vanish) / std::log(full / vanish), 0.0, 1.0);
}

}  // namespace

Picture::Picture(const FrozenMesh& mesh, const Layout& layout, const DrawOptions& options)
    : mesh_(mesh), layout_(layout) {
  const double margin = 8.0 * layout.unit / layout.scale;
  seen_ = {layout.window.low - Point{margin, margin}, layout.window.high + Point{margin, margin}};
  for (std::uint32_t i = 0; i < mesh.cell_count(); ++i) {
    const std::vector<Point> corners = corners_of(i);
    if (!box_of(corners).meets(layout.window)) continue;
    if (clip_polygon(corners, layout.window).size() >= 3) cells_.push_back(i);
  }
  if (options.field) {
    field_.emplace(mesh, layout, seen_, cells_, *options.field);
  } else {
    scale_ = color_scale(mesh, cells_, options.color);
  }
}

std::vector<Point> Picture::corners_of(std::uint32_t cell) const {
  std::vector<Point> corners;
  for (const std::uint32_t v : mesh_.cell(cell)) corners.push_back(mesh_.points[v]);
  return corners;
}

void Picture::fill_cells(cairo_t* cairo, Seams seams) const {
  if (field_) return field_->fill(cairo, cells_, seams);
  std::array<std::vector<std::uint32_t>, color_levels> levels;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    levels[static_cast<std::size_t>(scale_.positions[i] * (color_levels - 1) + 0.5)].push_back(cells_[i]);
  }
  cairo_set_line_width(cairo, 0.5 * layout_.unit);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_BEVEL);
  for (std::size_t level = 0; level < color_levels; ++level) {
    if (levels[level].empty()) continue;
    for (const auto cell : levels[level]) add_polygon(cairo, layout_, clip_polygon(corners_of(cell), seen_));
    set_color(cairo, color_at(scale_.map, static_cast<double>(level) / (color_levels - 1)));
    fill_path(cairo, seams);
  }
}

// The side of the equilateral triangle with the same area; a quadrilateral's area is half the product of its
// diagonals.
double Picture::side_in_pixels(std::uint32_t cell) const {
  const std::vector<Point> p = corners_of(cell);
  const double twice =
      std::abs(p.size() == 4 ? cross(p[2] - p[0], p[3] - p[1]) : cross(p[1] - p[0], p[2] - p[0]));
  return layout_.scale * std::sqrt(2.0 / std::numbers::sqrt3 * twice);
}

void Picture::stroke_edges(cairo_t* cairo) const {
  if (field_) return field_->stroke_iso_lines(cairo, cells_);
  constexpr std::size_t strengths = 16;  // one path for each, on dark and on bright colours
  const double dark = dark_end(scale_.map);
  std::array<std::array<EdgeList, strengths>, 2> edges;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double strength = edge_strength(side_in_pixels(cells_[i]) / layout_.unit);
    const auto level = static_cast<std::size_t>(strength * (strengths - 1) + 0.5);
    const auto corners = mesh_.cell(cells_[i]);
    for (std::size_t k = 0; level > 0 && k < corners.size(); ++k) {
      const std::array<std::uint32_t, 2> edge = {corners[k], corners[(k + 1) % corners.size()]};
      // Once from each inner edge's two cells; boundary edges are drawn over anyway.
      if (edge[0] < edge[1]) edges[scale_.positions[i] < dark ? 1 : 0][level].push_back(edge);
    }
  }
  for (std::size_t level = 1; level < strengths; ++level) {
    const double t = static_cast<double>(level) / (strengths - 1);
    cairo_set_line_width(cairo, (0.25 + 0.65 * t) * layout_.unit);
    add_segments(cairo, edges[0][level]);
    set_color(cairo, {0.05, 0.05, 0.10}, 0.75 * t);
    cairo_stroke(cairo);
    add_segments(cairo, edges[1][level]);
    set_color(cairo, {0.75, 0.75, 0.85}, 0.55 * t);
    cairo_stroke(cairo);
  }
}

void Picture::add_segments(cairo_t* cairo, const EdgeList& edges) const {
  for (const auto& [a, b] : edges) {
    add_segment(cairo, layout_, mesh_.points[a], mesh_.points[b], seen_);
  }
}

void Picture::stroke_boundaries(cairo_t* cairo) const {
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
    std::vector<Point> points;
    for (const auto& edge : mesh_.boundaries[k].edges) points.push_back(mesh_.points[edge[0]]);
    if (points.empty()) continue;
    const Box box = box_of(points);
    add_segments(cairo, mesh_.boundaries[k].edges);
    // A small body in a large picture must not drown in its own outline.
    const double extent = layout_.scale * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    set_color(cairo, field_ ? Color{0.1, 0.1, 0.1} : boundary_color(k));
    cairo_set_line_width(cairo, std::clamp(extent / 30.0, 0.8 * layout_.unit, 2.2 * layout_.unit));
    cairo_stroke(cairo);
  }
}

void Picture::color_bar(cairo_t* cairo, double left, double right, double top, double bottom) const {
  const int steps = scale_.legend_steps;
  for (int i = 0; i < steps; ++i) {
    const double from = left + (right - left) * i / steps;
    set_color(cairo, color_at(scale_.map, static_cast<double>(i) / (steps - 1)));
    cairo_rectangle(cairo, from, top, right - from, bottom - top);
    cairo_fill(cairo);
  }
  cairo_rectangle(cairo, left, top, right - left, bottom - top);
  cairo_set_source_rgb(cairo, 0.2, 0.2, 0.2);
  cairo_set_line_width(cairo, 0.8 * layout_.unit);
  cairo_stroke(cairo);
}

void Picture::boundary_names(cairo_t* cairo, double left, double baseline) const {
  const double unit = layout_.unit;
  for (std::size_t k = 0; k < mesh_.boundaries.size() && left < layout_.width; ++k) {
    set_color(cairo, boundary_color(k));
    cairo_set_line_width(cairo, 3.0 * unit);
    cairo_move_to(cairo, left, baseline - 5.0 * unit);
    cairo_line_to(cairo, left + 24.0 * unit, baseline - 5.0 * unit);
    cairo_stroke(cairo);
    left = put_text(cairo, left + 32.0 * unit, baseline, mesh_.boundaries[k].name) + 24.0 * unit;
  }
}

std::string Picture::what_is_seen() const {
  const Box& window = layout_.window;
  const std::string lines = field_ ? field_->iso_lines_in_words() : "";
  return std::to_string(cells_.size()) + " of " + std::to_string(mesh_.cell_count()) +
         (mesh_.quads.empty() ? " triangles; x from " : " cells; x from ") + label_of(window.low.x) + " to " +
         label_of(window.high.x) + ", y from " + label_of(window.low.y) + " to " + label_of(window.high.y) +
         lines;
}

void Picture::legend(cairo_t* cairo, const std::string& caption) const {
  const double unit = layout_.unit;
  const double margin = 16.0 * unit;
  const double first = layout_.plot_height + 34.0 * unit;
  const double second = layout_.plot_height + 66.0 * unit;
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, 17.0 * unit);

  if (field_) {
    field_->color_bar(cairo, margin, first);
    put_text(cairo, margin, second + 24.0 * unit, caption.empty() ? what_is_seen() : caption);
    return;
  }
  double x = put_text(cairo, margin, first, scale_.title) + 20.0 * unit;
  x = put_text(cairo, x, first, scale_.low) + 8.0 * unit;
  color_bar(cairo, x, x + 320.0 * unit, first - 15.0 * unit, first + 4.0 * unit);
  x = put_text(cairo, x + 328.0 * unit, first, scale_.high) + 48.0 * unit;
  boundary_names(cairo, x, first);

  put_text(cairo, margin, second, caption.empty() ? what_is_seen() : caption);
}

}  // namespace remodel::draw_detail
