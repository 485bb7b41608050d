#pragma once

// Cuts what is drawn to the window: a farfield seen through a window of a thousandth of a chord lies millions
// of pixels outside, more than cairo's 24-bit coordinates hold.

#include <optional>
#include <utility>
#include <vector>

#include "remodel/point.h"

namespace remodel::draw_detail {

struct Box {
  Point low, high;
  bool meets(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
};

// The part of a convex polygon inside the box (Sutherland and Hodgman 1974); may be empty.
std::vector<Point> clip_polygon(std::vector<Point> polygon, const Box& box);
// The part of a segment inside the box (Liang and Barsky 1984).
std::optional<std::pair<Point, Point>> clip_segment(Point a, Point b, const Box& box);

}  // namespace remodel::draw_detail
