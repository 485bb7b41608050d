#pragma once

// Where and how the flow leaves a body.

#include <array>
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

// Where the edge of a body that begins with the `base` vertices of its trailing edge points: away from the
// body, between its sides, of length 1.
Point edge_direction(std::span<const Point> body, std::size_t base);

// The least cosine, of an edge's direction and the stream's, with which the flow leaves there.
constexpr double least_cosine = -0.1;

// Whether there is anything that a flow without friction has to leave the body from: a trailing edge, or a
// corner where the outline turns by more than 60 degrees, which does not face the stream.
bool edge_faces_downstream(std::span<const Point> body, Point stream);

// Near a trailing edge with the angle theta in the fluid the speed along the wall, towards the edge, is
//   +-A s^(pi/theta - 1) + C s^(2 pi/theta - 1) +- ...,   s: distance from the edge,
// with + on one side and - on the other. The first term is the flow around the edge: Kutta's condition is A =
// 0. Along the two halves of edges that meet in the trailing edge (and along the whole of a blunt base) the
// integral of the clockwise speed against the hat functions of its vertices has the first term alone where
// these edges are equally long, and of the second one what follows from the speeds at both neighbours where
// they are not. So nothing but the flow in the triangles around the edge decides, however coarse the rest is.
//
// The condition: the sum of weight * (clockwise speed integrated against the vertex's hat function) is zero,
// by index into the body, which begins with the `base` vertices of its trailing edge.
struct KuttaTerm {
  std::size_t vertex;
  double weight;
};
struct KuttaCondition {
  std::vector<KuttaTerm> terms;
  // The nearest vertex on each side that the corners of a blunt base do not trouble: of a sharp edge its
  // neighbours.
  std::array<std::size_t, 2> beside = {};
  // With these weights the clockwise speeds integrated against the hat functions of those two sum up to the
  // first term alone: the same condition, from a little farther away. On a mesh that is fine enough there
  // both give the same circulation.
  std::array<double, 2> weights_beside = {};
};
KuttaCondition kutta_condition(std::span<const Point> body, std::size_t base);

}  // namespace remodel::flow
