#pragma once

#include "remodel/point.h"
#include "remodel/predicates.h"

namespace remodel {

// Whether p lies in the triangle or on its edge, exactly. (a, b, c) is counter-clockwise.
inline bool in_triangle(Point a, Point b, Point c, Point p) {
  return orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0;
}

}  // namespace remodel
