#pragma once

// The two questions that decide every topology in this library, answered exactly.
//
// Method: a static filter in double arithmetic (error constants of J. R. Shewchuk, "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997), then exact arithmetic: 256-bit
// integers where the coordinates' differences fit, as those of ties mostly do, and expansions everywhere
// else. Coordinates must be finite and their products must neither overflow nor underflow: magnitudes from
// 1e-60 to 1e60 (and exact zeros) are safe.

#include <cmath>

#include "remodel/point.h"

namespace remodel {

// True if both coordinates are in the range that is safe: not for infinities and NaN.
inline bool safe_for_predicates(Point p) {
  const auto safe = [](double v) { return v == 0.0 || (std::abs(v) <= 1e60 && std::abs(v) >= 1e-60); };
  return safe(p.x) && safe(p.y);
}

// The sign of the signed area of triangle abc: +1 counter-clockwise, -1 clockwise, 0 collinear.
//  (1) orient2d(a,b,c) == orient2d(b,c,a) == -orient2d(b,a,c)
//  (2) it is the sign of the exact determinant of the given doubles
int orient2d(Point a, Point b, Point c);

// The position of d relative to the circle through a, b, c, which are in counter-clockwise order:
// +1 inside, -1 outside, 0 on the circle.
//  (1) incircle(a,b,c,d) == incircle(b,c,a,d)
//  (2) incircle(a,b,c,d) == -incircle(b,a,c,d)
//  (3) it is the sign of the exact determinant of the given doubles
int incircle(Point a, Point b, Point c, Point d);

// incircle without ties, for four distinct points, not all collinear, a, b, c in counter-clockwise order:
// never 0, so that the Delaunay triangulation of a point set is unique.
//  (1) equals incircle(a,b,c,d) where that is not 0
//  (2) otherwise the sign after an infinitesimal lift of the points, the lexicographically largest point
//      lifted most (Devillers and Teillaud, "Perturbations for Delaunay and weighted Delaunay 3D
//      triangulations", 2011): a function of the four points alone, not of their order or ids
//  (3) for the two triangulations of a convex quadrilateral a, b, c, d exactly one is Delaunay:
//      incircle_sos(a,b,c,d) == -incircle_sos(b,c,d,a)
int incircle_sos(Point a, Point b, Point c, Point d);

// How many calls each stage decided since the program started, for tests and benchmarks. Counted only in
// builds with REMODEL_PREDICATE_STATISTICS; zeros otherwise. The orient2d calls that break ties are counted
// too.
struct PredicateStatistics {
  unsigned long long orient_filtered = 0, orient_exact = 0;
  unsigned long long incircle_filtered = 0;
  unsigned long long incircle_integer = 0;  // exact, by 256-bit integers
  unsigned long long incircle_exact = 0;    // exact, by expansions
  unsigned long long incircle_ties = 0;     // of incircle_sos; each is also one of the exact ones
};
PredicateStatistics predicate_statistics();

}  // namespace remodel
