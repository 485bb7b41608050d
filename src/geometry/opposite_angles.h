#pragma once

// How far an edge is from being Delaunay: the sum of the angles opposite to it, 180 degrees at most where it
// is.

#include <cmath>
#include <numbers>

#include "remodel/point.h"

namespace remodel {

// The largest sum of opposite angles that is taken, as 180 degrees and a slack of less than 90.
class OppositeAngles {
 public:
  explicit OppositeAngles(double slack_deg)
      : tangent_(std::tan(slack_deg * std::numbers::pi / 180.0)),
        sine_(std::sin(0.5 * slack_deg * std::numbers::pi / 180.0)) {}

  // Whether the angles of p and q over the edge a-b sum up to no more, with p on its left, q on its right: up
  // to rounding, where a relative margin (more for whoever makes a mesh than for whoever checks it) tells
  // apart. The angle at p is the argument of (dot, cross) of the directions to a and b; the sum that of the
  // product.
  bool within(Point a, Point b, Point p, Point q, double margin) const {
    const double dp = dot(a - p, b - p), cp = cross(a - p, b - p);
    const double dq = dot(b - q, a - q), cq = cross(b - q, a - q);
    const double x = dp * dq - cp * cq, y = dp * cq + cp * dq;
    return y >= 0.0 || (x < 0.0 && -y <= -x * tangent_ * margin);
  }
  // Whether the angle of p over the boundary edge a-b is at most 90 degrees and half of the slack.
  bool within(Point p, Point a, Point b) const {
    const double d = dot(a - p, b - p);
    return d >= 0.0 || d * d <= sine_ * sine_ * squared_distance(a, p) * squared_distance(b, p);
  }

 private:
  double tangent_, sine_;
};

}  // namespace remodel
