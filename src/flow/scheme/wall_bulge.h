#pragma once

// How far walls bulge beyond the chords of their edges. Fluxes through the halves of a chord, at weights 5/6
// and 1/6 of its ends, are those of an exact linear scheme where its middle is moved by h^2 / 6R (not by the
// h^2 / 8R that a circle is away): docs/notebook/flow_walls.md. At the weights 1 and 0 of quadrilaterals it
// is h^2 / 4R.

#include <array>
#include <cmath>

#include "flow/physics/dual.h"

namespace remodel::flow {

inline double bulge_factor(bool of_triangle) {
  return of_triangle ? 1.0 : 1.5;
}

// The outward move of the middle of the edge from a to b over the edge's length, h / 6R: `p` has the
// coordinates of the wall's vertices before a, a, b and after b, the domain on the left. 1 / R is the mean of
// the curvatures of the circles through a and through b and their neighbours; a vertex where the wall turns
// counts less, by the squared cosine of the turn, and one where it turns by a right angle or more (a trailing
// edge), or that has no neighbour, not at all.
template <class T>
T wall_bulge(const std::array<T, 8>& p, bool has_before, bool has_after) {
  using std::sqrt;
  T sum(0.0), weights(0.0);
  for (std::size_t end = 0; end < 2; ++end) {
    if (!(end == 0 ? has_before : has_after)) continue;
    const std::size_t i = 2 * end;
    const T ux = p[i + 2] - p[i], uy = p[i + 3] - p[i + 1];
    const T vx = p[i + 4] - p[i + 2], vy = p[i + 5] - p[i + 3];
    const T along = ux * vx + uy * vy, u2 = ux * ux + uy * uy, v2 = vx * vx + vy * vy;
    if (!(value_of(along) > 0.0)) continue;
    const T weight = along * along / (u2 * v2);
    const T whole = u2 + v2 + 2.0 * along;
    const T other = end == 0 ? u2 : v2;
    sum = sum + weight * weight * ((ux * vy - uy * vx) / (3.0 * sqrt(other * whole)));
    weights = weights + weight;
  }
  return value_of(weights) > 0.0 ? sum / weights : T(0.0);
}

}  // namespace remodel::flow
