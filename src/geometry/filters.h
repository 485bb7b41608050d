#pragma once

// The predicates of remodel/predicates.h with their static filters inline, for hot loops inside the library.
// Same answers: whatever the filter cannot decide goes to the exact functions out of line.

#include <cmath>

#include "remodel/point.h"

#ifdef REMODEL_PREDICATE_STATISTICS
#include <atomic>
#endif

namespace remodel::geometry {

// With u = 2^-53 the largest relative error of one rounding: J. R. Shewchuk, "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997).
//
// Section 4.1, ORIENT2D stage A: two rounded differences and a product give each of left and right a relative
// error of 3u + O(u^2), the last subtraction stays below u times the result, and 16 u^2 cover the higher
// orders and the rounding of the bound itself: (3 + 16u) u.
inline constexpr double orient2d_error = 3.3306690738754716e-16;
// Section 4.4, INCIRCLE stage A, relative to the permanent (the determinant with every product taken
// positively): (10 + 96u) u.
inline constexpr double incircle_error = 1.1102230246251577e-15;

int orient2d_exact(Point a, Point b, Point c);
int incircle_exact(Point a, Point b, Point c, Point d);
// The symbolic answer for four cocircular points.
int incircle_tie(Point a, Point b, Point c, Point d);

#ifdef REMODEL_PREDICATE_STATISTICS
struct PredicateCounters {
  std::atomic<unsigned long long> orient_filtered{0}, orient_exact{0};
  std::atomic<unsigned long long> incircle_filtered{0}, incircle_integer{0}, incircle_exact{0},
      incircle_ties{0};
};
inline PredicateCounters predicate_counters;
#define REMODEL_COUNT_PREDICATE(stage) \
  (::remodel::geometry::predicate_counters.stage.fetch_add(1, std::memory_order_relaxed))
#else
#define REMODEL_COUNT_PREDICATE(stage) static_cast<void>(0)
#endif

inline int orient2d_filtered(Point a, Point b, Point c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = orient2d_error * (std::abs(left) + std::abs(right));
  if (std::abs(determinant) > bound) {
    REMODEL_COUNT_PREDICATE(orient_filtered);
    return determinant > 0.0 ? 1 : -1;
  }
  return orient2d_exact(a, b, c);
}

inline int incircle_filtered(Point a, Point b, Point c, Point d) {
  const Point u = a - d;
  const Point v = b - d;
  const Point w = c - d;
  const double vw = v.x * w.y, wv = w.x * v.y;
  const double wu = w.x * u.y, uw = u.x * w.y;
  const double uv = u.x * v.y, vu = v.x * u.y;
  const double u_lift = dot(u, u), v_lift = dot(v, v), w_lift = dot(w, w);
  const double determinant = u_lift * (vw - wv) + v_lift * (wu - uw) + w_lift * (uv - vu);
  const double permanent = u_lift * (std::abs(vw) + std::abs(wv)) + v_lift * (std::abs(wu) + std::abs(uw)) +
                           w_lift * (std::abs(uv) + std::abs(vu));
  if (std::abs(determinant) > incircle_error * permanent) {
    REMODEL_COUNT_PREDICATE(incircle_filtered);
    return determinant > 0.0 ? 1 : -1;
  }
  return incircle_exact(a, b, c, d);
}

inline int incircle_sos_filtered(Point a, Point b, Point c, Point d) {
  const int sign = incircle_filtered(a, b, c, d);
  return sign != 0 ? sign : incircle_tie(a, b, c, d);
}

}  // namespace remodel::geometry
