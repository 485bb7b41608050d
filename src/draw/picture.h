#pragma once

// Where a mesh lies on the canvas, and how its parts are drawn there.

#include <cairo.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "draw/clip.h"
#include "draw/color_scale.h"
#include "remodel/draw.h"

namespace remodel::draw_detail {

// The plot fills the canvas from the top; legend and caption stand in a strip below it.
struct Layout {
  Box window;           // what is seen, chords
  int width = 0;        // of the canvas and of the plot, pixels
  int plot_height = 0;  // pixels
  int height = 0;       // of the canvas
  double scale = 1.0;   // pixels a chord
  double unit = 1.0;    // pixels of a line one thick: lines and letters grow with the canvas

  Point pixel(Point p) const { return {scale * (p.x - window.low.x), scale * (window.high.y - p.y)}; }
};
Layout layout_for(const FrozenMesh& mesh, const DrawOptions& options);

using EdgeList = std::vector<std::array<std::uint32_t, 2>>;

class Picture {
 public:
  // mesh must outlive the picture.
  Picture(const FrozenMesh& mesh, const Layout& layout, DrawColor color);

  // fill: draw over the hairlines that smoothed edges leave between neighbours.
  enum class Seams { leave, fill };
  void fill_triangles(cairo_t* cairo, Seams seams) const;
  void stroke_edges(cairo_t* cairo) const;
  void stroke_boundaries(cairo_t* cairo) const;
  void legend(cairo_t* cairo) const;

 private:
  void add_polygon(cairo_t* cairo, const std::vector<Point>& polygon) const;
  void add_segments(cairo_t* cairo, const EdgeList& edges) const;
  double side_in_pixels(std::uint32_t triangle) const;
  void color_bar(cairo_t* cairo, double left, double right, double top, double bottom) const;
  void boundary_names(cairo_t* cairo, double left, double baseline) const;

  const FrozenMesh& mesh_;
  Layout layout_;
  Box seen_;                              // the window and a little more: strokes must not end at its edge
  std::vector<std::uint32_t> triangles_;  // those that meet the window
  ColorScale scale_;
};

}  // namespace remodel::draw_detail
