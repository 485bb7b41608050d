#pragma once

// A field in colours: bands of equal colours cut out of each triangle, where the field is linear. A
// quadrilateral is two triangles, or one where the field is constant.

#include <cairo.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "draw/clip.h"
#include "draw/layout.h"

namespace remodel::draw_detail {

// A corner of a polygon in which a field is linear.
struct ValuedPoint {
  Point point;
  double value;
};
// The part of a convex polygon where low <= value <= high. Neighbours that share an edge are cut at the same
// points.
std::vector<ValuedPoint> between_values(std::vector<ValuedPoint> polygon, double low, double high);

// Multiples of 1, 2 or 5 times a power of ten inside the range, four to eleven of them.
std::vector<double> ticks_within(double low, double high);

class FieldPainter {
 public:
  // mesh must outlive the painter; cells: those that are seen. Throws Error (argument) as draw() does.
  FieldPainter(const FrozenMesh& mesh, const Layout& layout, const Box& seen,
               std::span<const std::uint32_t> cells, const DrawField& options);

  void fill(cairo_t* cairo, std::span<const std::uint32_t> cells, Seams seams) const;
  void stroke_iso_lines(cairo_t* cairo, std::span<const std::uint32_t> cells) const;
  void color_bar(cairo_t* cairo, double left, double baseline) const;
  std::string iso_lines_in_words() const;  // empty if there are none

 private:
  // At the corners of a cell: 0 at the low end of the range, 1 at its high end.
  std::vector<ValuedPoint> corners(std::uint32_t cell) const;
  std::vector<std::vector<ValuedPoint>> polygons(std::uint32_t cell) const;

  const FrozenMesh& mesh_;
  Layout layout_;
  Box seen_;
  FieldPlace place_;
  std::vector<double> values_;  // of one component
  std::string label_;
  double low_ = 0.0, high_ = 1.0;
  int iso_lines_ = 0;
};

}  // namespace remodel::draw_detail
