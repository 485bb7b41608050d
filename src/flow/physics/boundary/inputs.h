#pragma once

// What a boundary condition sees of the half of a boundary edge that belongs to the vertex `here`.

#include "flow/physics/stream.h"

namespace remodel::flow {

// Weights of an edge's ends in the middle of a half.
inline constexpr double near_place = 0.75, far_place = 0.25;

template <class T>
struct BoundaryInputs {
  Unknowns<T> here, there;                 // at the vertex, and at the edge's other end
  PlaneVector<T> half, normal;             // outer normals, of the half and of the edge; as long as these
  PlaneVector<T> place_here, place_there;  // of both vertices
  T mach, alpha;                           // of the stream, radians
  T lift;                                  // coefficient of the far field's vortex
  // Weights of both in the state of the half, by which fluxes that are linear are exact: 5/6 and 1/6 on
  // triangles, 1 and 0 on quadrilaterals. H. Nishikawa, J. Comput. Phys. 281 (2015), section 3.
  double near = 5.0 / 6.0, far = 1.0 / 6.0;

  Unknowns<T> mean() const {
    Unknowns<T> result;
    for (std::size_t k = 0; k < unknown_count; ++k) result[k] = near * here[k] + far * there[k];
    return result;
  }
  PlaneVector<T> place() const {  // of that state
    return {near * place_here.x + far * place_there.x, near * place_here.y + far * place_there.y};
  }
  PlaneVector<T> unit_normal() const {  // of the half
    using std::sqrt;
    const T length = sqrt(half.x * half.x + half.y * half.y);
    return {half.x / length, half.y / length};
  }
};

}  // namespace remodel::flow
