#pragma once

// How the parts of a mesh are drawn on the canvas.

#include <cairo.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "draw/clip.h"
#include "draw/color_scale.h"
#include "draw/field_painter.h"
#include "draw/layout.h"
#include "remodel/draw.h"

namespace remodel::draw_detail {

using EdgeList = std::vector<std::array<std::uint32_t, 2>>;

class Picture {
 public:
  // mesh must outlive the picture.
  Picture(const FrozenMesh& mesh, const Layout& layout, const DrawOptions& options);

  void fill_cells(cairo_t* cairo, Seams seams) const;
  void stroke_edges(cairo_t* cairo) const;  // or the iso-lines of a field
  void stroke_boundaries(cairo_t* cairo) const;
  void legend(cairo_t* cairo, const std::string& caption) const;

 private:
  void add_segments(cairo_t* cairo, const EdgeList& edges) const;
  double side_in_pixels(std::uint32_t cell) const;
  void color_bar(cairo_t* cairo, double left, double right, double top, double bottom) const;
  std::string what_is_seen() const;
  void boundary_names(cairo_t* cairo, double left, double baseline) const;

  std::vector<Point> corners_of(std::uint32_t cell) const;

  const FrozenMesh& mesh_;
  Layout layout_;
  Box seen_;                          // the window and a little more: strokes must not end at its edge
  std::vector<std::uint32_t> cells_;  // those that meet the window
  ColorScale scale_;
  std::optional<FieldPainter> field_;  // instead of the scale
};

}  // namespace remodel::draw_detail
