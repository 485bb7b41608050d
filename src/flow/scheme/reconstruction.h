#pragma once

// Reconstruction makes values in the middle of an edge from values and gradients at its ends.
//
// Sources: G. D. van Albada, B. van Leer and W. W. Roberts, "A comparative study of computational methods in
// cosmic gas dynamics", Astron. Astrophys. 108 (1982).

#include "flow/physics/euler.h"
#include "flow/scheme/flow_mesh.h"

namespace remodel::flow {

// Van Albada's function of two slopes, both as differences over an edge's length: 1 where they are equal. It
// has no minimum over neighbours and is continuously differentiable, so that Newton's method converges
// quadratically; it is cut off at zero by a parabola of this half-width.
template <class T, class Q, class E>
T slope_limiter(const Q& upwind, const Q& central, const E& epsilon) {
  constexpr double blend = 0.1;
  const T s = (2.0 * upwind * central + epsilon) / (upwind * upwind + central * central + epsilon);
  if (value_of(s) <= -blend) return T(0.0);
  if (value_of(s) < blend) return (s + blend) * (s + blend) * (0.25 / blend);
  return s;
}
inline constexpr double kappa = 1.0 / 3.0;

// The part of the limiter that acts between two vertices: none where both are subsonic, all of it where one has
// Mach 1.2 or more. There is no shock in subsonic flow, and a limiter would clip its suction peaks.
template <class Q>
Q limited_part(const Unknowns<Q>& a, const Unknowns<Q>& b) {
  constexpr double from = 1.0, width = 0.44;  // of squares of Mach numbers
  const auto ramp = [&](const Unknowns<Q>& q) {
    const Q s = (mach_squared(q) - from) / width;
    if (value_of(s) <= 0.0) return Q(0.0);
    if (value_of(s) >= 1.0) return Q(1.0);
    return s * s * (3.0 - 2.0 * s);
  };
  const Q at_a = ramp(a), at_b = ramp(b);
  return at_a + at_b - at_a * at_b;
}

// The ends of an edge as reconstruction sees them: inner, or one on a wall and one beside it. The gradient at
// a wall is one-sided, off by one order, and the entropy that it makes stays on the wall. Between a wall and
// the inside the upwind difference at the wall is therefore extrapolated, central + theta * (central - the one
// at the other end). With theta = 1 both ends' values meet. That is right where the two differences agree, and
// leaves Roe's flux without dissipation where they do not: around a slat's or a flap's nose the flow then makes
// entropy until it leaves the wall. There theta goes to -1, the difference at the other end. Such edges cross
// the flow and are not limited.
enum class EdgeEnd { inner, wall, beside_wall };
inline EdgeEnd end_of(const FlowMesh& mesh, std::uint32_t here, std::uint32_t there) {
  if (mesh.one_sided(here) == mesh.one_sided(there)) return EdgeEnd::inner;
  return mesh.one_sided(here) ? EdgeEnd::wall : EdgeEnd::beside_wall;
}
// The vertices whose gradients the upwind differences at both ends are of.
inline std::array<std::uint32_t, 2> gradient_sources(const FlowMesh& mesh, const DualEdge& edge) {
  return {end_of(mesh, edge.a, edge.b) == EdgeEnd::wall ? edge.b : edge.a,
          end_of(mesh, edge.b, edge.a) == EdgeEnd::wall ? edge.a : edge.b};
}
// The weight of an end's extrapolation correction: the gradient at a wall is none to linearise with.
inline double correction_weight(EdgeEnd end) {
  return end == EdgeEnd::inner ? 0.5 : end == EdgeEnd::wall ? 0.0 : 1.0;
}

// From the value at the end to that in the middle: third order on even spacing (kappa = 1/3) where nothing
// limits it. And how much further linear extrapolation (kappa = 0) goes.
template <class T>
struct ReconstructionStep {
  T step, further;
};
// `limited` is limited_part() of the edge's ends.
template <class T, class Q, class E>
ReconstructionStep<T> reconstruction_step(EdgeEnd end, const Q& upwind, const Q& central, const E& epsilon,
                                          const Q& limited) {
  T s(1.0), own(upwind);
  if (end == EdgeEnd::inner) {
    if (value_of(limited) > 0.0) s = 1.0 - limited * (1.0 - slope_limiter<T>(upwind, central, epsilon));
  } else if (end == EdgeEnd::wall) {
    const T alike = slope_limiter<T>(upwind, central, 0.01 * epsilon), squared = alike * alike;
    own = central + (2.0 * (squared * squared) - 1.0) * (central - upwind);
  }
  return {0.25 * s * ((1.0 - kappa * s) * own + (1.0 + kappa * s) * central),
          0.25 * kappa * (s * s) * (own - central)};
}

// The positivity-preserving limiter: a reconstructed density or pressure keeps away from vacuum. Below
// `limited_part` of the vertex's it approaches `least_part` of it, along a hyperbola that leaves the
// derivative continuous.
template <class T, class Q>
T positivity_limited(const T& reconstructed, const Q& vertex) {
  constexpr double limited_part = 0.3, least_part = 0.1, s = limited_part - least_part;
  if (!(value_of(reconstructed) < limited_part * value_of(vertex))) return reconstructed;
  const T ratio = s / (s + limited_part - reconstructed / vertex);
  return (least_part + s * ratio) * vertex;
}

}  // namespace remodel::flow
