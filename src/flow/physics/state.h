#pragma once

// The unknowns of a vertex, by name. Nothing outside of src/flow/physics knows their order or their number,
// which everything else is a template or a constant expression of.

#include <array>
#include <cstddef>

namespace remodel::flow {

inline constexpr std::size_t unknown_count = 4;

// Density, velocity and pressure, or what belongs to each: a difference, a derivative.
template <class T>
using Unknowns = std::array<T, unknown_count>;

template <class T>
const T& density(const Unknowns<T>& q) {
  return q[0];
}
template <class T>
const T& velocity_x(const Unknowns<T>& q) {
  return q[1];
}
template <class T>
const T& velocity_y(const Unknowns<T>& q) {
  return q[2];
}
template <class T>
const T& pressure(const Unknowns<T>& q) {
  return q[3];
}

// The unknowns of which a state of a gas has no zero and nothing below.
inline constexpr std::array<std::size_t, 2> positive_unknowns = {0, 3};

// Fluxes of mass, momentum and energy, and what they add up to: residuals.
template <class T>
using Fluxes = std::array<T, unknown_count>;

// The same numbers in another type.
template <class T>
Unknowns<T> unknowns_of(const Unknowns<double>& q) {
  Unknowns<T> result;
  for (std::size_t k = 0; k < unknown_count; ++k) result[k] = T(q[k]);
  return result;
}

}  // namespace remodel::flow
