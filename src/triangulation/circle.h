#pragma once

// Circumcircles in floating point that know how far they may be wrong.

#include <cmath>
#include <limits>

#include "remodel/point.h"

namespace remodel {

// A circumcircle that says what it is sure of. Made by certified_circle().
struct Circle {
  Point centre;          // rounded
  double inside = -1.0;  // a squared distance from centre below this is certainly inside the true circle
  double outside = std::numeric_limits<double>::infinity();  // above this certainly outside

  // Infinite where nothing is certain: slivers, ghosts.
  double squared_radius() const { return 0.5 * (inside + outside); }
  bool certain() const { return inside > 0.0; }  // then its triangle is certainly counter-clockwise too
  friend bool operator==(const Circle&, const Circle&) = default;
};

// The circle of a, b, c from a, the edges e1 = b - a and e2 = c - a as rounded, and their squared lengths.
//
// Relative to corner a: with D = e1 x e2, s = |D| / (|e1||e2|) the sine at a, the centre is a + u,
// u = perp(e2 |e1|^2 - e1 |e2|^2) / 2D. With eps = 2^-53 and rounded operations:
//   numerator of u: |error| <= 8 eps |e1||e2|(|e1|+|e2|); D: |error| <= 4 eps |e1||e2|, relative 4 eps / s;
//   so |u - computed u| <= eps (|e1|+|e2|) 10 / s^2 <= 40 eps r / s^2       (|e1|, |e2| <= 2r; s >= 2^-20
//   below) and rounding the centre itself adds eps (|cx|+|cy|) (1 + eps).
// Let delta be their sum: the true centre is within delta of the stored one, and the true radius within delta
// of |u|. A point is certainly inside if its distance from the stored centre is below |u| - 2 delta,
// certainly outside above |u| + 2 delta. Squared: r^2 -+ 4 r delta, with 16 eps r^2 for the rounding of the
// squares here and in the query. tolerance below is that sum with each constant rounded up by a quarter or
// more.
inline Circle certified_circle(Point a, Point e1, Point e2, double l1, double l2) {
  Circle circle;
  const double d = cross(e1, e2);
  const double half_inverse = 0.5 / d;
  const Point u{(e2.y * l1 - e1.y * l2) * half_inverse, (e1.x * l2 - e2.x * l1) * half_inverse};
  circle.centre = a + u;
  const double r2 = dot(u, u);
  const double inverse_s2 = 4.0 * l1 * l2 * half_inverse * half_inverse;
  constexpr double eps = 0x1p-53;
  const double tolerance =
      eps * ((200.0 * inverse_s2 + 32.0) * r2 +
             6.0 * std::sqrt(r2) * (std::abs(circle.centre.x) + std::abs(circle.centre.y)));
  // Without a branch: loops over many triangles are vectorised.
  const bool sure = (d > 0.0) & (inverse_s2 < 0x1p40) & (tolerance < 0.25 * r2);
  circle.inside = sure ? r2 - tolerance : circle.inside;
  circle.outside = sure ? r2 + tolerance : circle.outside;
  return circle;
}
inline Circle certified_circle(Point a, Point b, Point c) {
  const Point e1 = b - a, e2 = c - a;
  return certified_circle(a, e1, e2, dot(e1, e1), dot(e2, e2));
}

}  // namespace remodel
