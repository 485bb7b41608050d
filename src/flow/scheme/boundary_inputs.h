#pragma once

// What a boundary condition sees of the half of a boundary edge, in every system of equations.

#include "flow/linear/augmented.h"
#include "flow/physics/stream.h"
#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// half: 0 that of the edge's first end, 1 that of its second. `gas` has the gas at a vertex.
template <class T, class Gas>
BoundaryInputs<T> boundary_inputs_of(const FlowMesh& mesh, const Stream& stream, const Augmented& augmented,
                                     const BoundaryEdge& edge, std::size_t half, Gas gas) {
  const std::uint32_t here = half == 0 ? edge.a : edge.b, there = half == 0 ? edge.b : edge.a;
  return {.here = unknowns_of<T>(gas(here)),
          .there = unknowns_of<T>(gas(there)),
          .half = edge.half[half],
          .normal = edge.normal,
          .place_here = mesh.points()[edge.place[half]],
          .place_there = mesh.points()[edge.place[1 - half]],
          .mach = T(stream.mach),
          .alpha = T(augmented[1]),
          .lift = T(augmented[0]),
          .near = edge.of_triangle ? 5.0 / 6.0 : 1.0,
          .far = edge.of_triangle ? 1.0 / 6.0 : 0.0};
}

}  // namespace remodel::flow
