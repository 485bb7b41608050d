#pragma once

// Where and how the flow leaves a body.

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "remodel/point.h"

namespace remodel::flow {

// The end of a clockwise body: one sharp corner, or the vertices of a blunt base from its upper to its lower
// corner.
struct TrailingEdge {
  std::size_t first;  // index into the body
  std::size_t count;
};

// The most downstream corner (largest x) that is sharper than 60 degrees. Where there is none, the most
// downstream pair of corners sharper than 135 degrees with at most 3 % of the outline between them. Nothing
// if there is neither.
std::optional<TrailingEdge> trailing_edge(std::span<const Point> body);

// Near a trailing edge with the angle theta in the fluid the speed along the wall, towards the edge, is
//   +-A s^(pi/theta - 1) + C s^(2 pi/theta - 1) +- B s^(3 pi/theta - 1) + ...,   s: distance from the edge,
// with + on one side and - on the other. The first term is the flow around the edge: Kutta's condition is A =
// 0. From farther than twice its width a blunt base is taken for an edge between the surfaces beside it. A is
// a weighted sum of the speeds along the wall (clockwise) at the nearest vertices on both sides; the sum's
// terms, by index into the body, which begins with the `base` vertices of its trailing edge. Speeds are means
// weighted by the vertices' hat functions.
std::vector<std::pair<std::size_t, double>> kutta_weights(std::span<const Point> body, std::size_t base);

}  // namespace remodel::flow
