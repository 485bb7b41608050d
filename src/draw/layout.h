#pragma once

// Where a mesh lies on the canvas, and what every part of a picture is drawn with.

#include <cairo.h>

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
// Throws Error (argument) for options out of range and a mesh without points.
Layout layout_for(const FrozenMesh& mesh, const DrawOptions& options);

Box box_of(const std::vector<Point>& points);
void set_color(cairo_t* cairo, const Color& color, double opacity = 1.0);
void add_polygon(cairo_t* cairo, const Layout& layout, const std::vector<Point>& polygon);
// The part of it inside the box.
void add_segment(cairo_t* cairo, const Layout& layout, Point a, Point b, const Box& box);
// Returns where the text ends.
double put_text(cairo_t* cairo, double x, double baseline, const std::string& text);
double text_width(cairo_t* cairo, const std::string& text);

// fill: draw over the hairlines that smoothed edges leave between neighbours.
enum class Seams { leave, fill };
void fill_path(cairo_t* cairo, Seams seams);

}  // namespace remodel::draw_detail
