#pragma once

// The room in front of walls: the ball that touches a wall at a point and has no other point of a boundary inside.

#include <vector>

#include "remodel/point.h"

namespace remodel {

class WallBalls {
 public:
  // Points on all boundaries. Sorted by x, so that a search looks at a strip alone.
  explicit WallBalls(std::vector<Point> samples);
  // The radius of the ball at p towards n, or `most` where it is larger: the least |q - p|^2 / (2 (q - p) . n) over
  // all q in front of the wall.
  double radius(Point p, Point n, double most) const;

 private:
  std::vector<Point> samples_;
};

}  // namespace remodel
