#pragma once

// Axis-parallel boxes.

#include <algorithm>
#include <limits>

#include "remodel/point.h"

namespace remodel {

// Empty until something is added.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void add(const Box& other) { add(other.low), add(other.high); }
  bool overlaps(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
  // 0 inside.
  double squared_distance(Point p) const {
    const double x = std::max({low.x - p.x, 0.0, p.x - high.x}),
                 y = std::max({low.y - p.y, 0.0, p.y - high.y});
    return x * x + y * y;
  }
};

}  // namespace remodel
