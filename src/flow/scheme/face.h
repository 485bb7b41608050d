#pragma once

// What a term sees of the face between the dual cells of two vertices, and the derivatives of its flux.

#include <type_traits>

#include "flow/linear/augmented.h"
#include "flow/physics/euler.h"
#include "flow/scheme/reconstruction.h"

namespace remodel::flow {

// Q: the kind of numbers that states are of, G: that of places.
template <class Q, class G>
struct FaceInputs {
  EdgeEnd end[2];         // what the edge's ends are
  Unknowns<Q> q[2];       // states at both
  Unknowns<Q> along[2];   // the gradients of both ends' sources, times the edge's vector
  PlaneVector<G> normal;  // of the face, from the first end to the second; as long as the face
  PlaneVector<G> edge;    // from the first vertex to the second
  G length;               // what the limiter compares edges with
};

// The variables are the states at both ends and both products of gradients.
struct FaceDerivative {
  Block by_state[2] = {{}, {}}, by_along[2] = {{}, {}};
};

// Differentiates any term, by dual numbers over all local unknowns.
template <class Term>
FaceDerivative general_derivative(const Term& term, const FaceInputs<double, double>& face) {
  constexpr std::size_t n = unknown_count;
  using Local = Dual<4 * n>;
  FaceInputs<Local, double> in = {.end = {face.end[0], face.end[1]},
                                  .q = {},
                                  .along = {},
                                  .normal = face.normal,
                                  .edge = face.edge,
                                  .length = face.length};
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < n; ++k) {
      in.q[side][k] = Local::variable(face.q[side][k], side * n + k);
      in.along[side][k] = Local::variable(face.along[side][k], (2 + side) * n + k);
    }
  const Fluxes<Local> flux = term.flux(in);
  FaceDerivative result;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        result.by_state[side][n * i + k] = flux[i].slope[side * n + k];
        result.by_along[side][n * i + k] = flux[i].slope[(2 + side) * n + k];
      }
  return result;
}

}  // namespace remodel::flow
