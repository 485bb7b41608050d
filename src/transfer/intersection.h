#pragma once

// The intersection of two triangles.

#include <array>

#include "remodel/point.h"

namespace remodel {

using Corners = std::array<Point, 3>;  // counter-clockwise

struct Intersection {
  double area = 0.0;
  Point centroid;  // where the area is not 0
};

// Which corners lie inside the other triangle and which edges cross is decided by exact predicates; only the
// places where edges cross are rounded.
Intersection intersect(const Corners& a, const Corners& b);

inline double area_of(const Corners& t) {
  return 0.5 * cross(t[1] - t[0], t[2] - t[0]);
}
inline Point centroid_of(const Corners& t) {
  return (1.0 / 3.0) * (t[0] + t[1] + t[2]);
}
// The barycentric coordinates of p: the weights of corners in the linear function at p.
inline std::array<double, 3> weights_at(const Corners& t, Point p) {
  const double scale = 1.0 / cross(t[1] - t[0], t[2] - t[0]);
  const double second = scale * cross(p - t[0], t[2] - t[0]), third = scale * cross(t[1] - t[0], p - t[0]);
  return {1.0 - second - third, second, third};
}
// The point of the triangle's edges that is nearest to p.
Point nearest_on_edges(const Corners& t, Point p);

}  // namespace remodel
