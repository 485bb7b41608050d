#pragma once

// What is given of a flow: the undisturbed stream, and what scales and limits.

#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "flow/physics/euler.h"

namespace remodel::flow {

inline constexpr double one_degree = M_PI / 180.0;

struct Stream {
  double mach = 0.0;
  double alpha = 0.0;               // radians; the first guess where lift is given
  std::optional<double> lift = {};  // the lift coefficient that alpha is to be found for
  Point reference = {0.25, 0.0};    // the vortex, and the point that moments are about
  // What lift and moment are made with in here, and what the limiter compares edges with: the extent of the
  // walls. Flows do not depend on what coefficients are reported with, `reference_length`.
  double length = 1.0;
  double reference_length = 1.0;
  std::optional<std::array<double, 2>> transition = {};  // of turbulent flow, as FlowConditions has it
  std::optional<double> wall_temperature = {};           // likewise, of flows with friction
  bool vortex = true;
  double limiter = 30.0;  // K: slopes of less than (K h / length)^(3/2) are not limited
  // Instead of the stream: the state at points of the far field, for flows with known solutions.
  std::function<Unknowns<double>(Point)> prescribed = nullptr;
  // What is added to mass, momentum and energy in each dual cell, for flows made to order; empty: nothing.
  std::vector<Fluxes<double>> source = {};
  // The part of each step of the reconstruction that is taken: 1 is the scheme, 0 the one of first order,
  // less than 1 a stage on the way to a flow.
  double slopes = 1.0;
  double working_slopes = 1.0;  // likewise, of the turbulence model's working variable alone
};

// What the coefficients that are reported are, over those in here: a length over another.
inline double reported_length(const Stream& stream) {
  return stream.length / stream.reference_length;
}

// Total pressure and square of the total speed of sound of a stream whose speed of sound and density are 1.
template <class T>
struct TotalState {
  T pressure, sound_square;
};
template <class T>
TotalState<T> total_state(const T& mach) {
  using std::pow;
  const T factor = 1.0 + 0.5 * (gas_gamma - 1.0) * mach * mach;
  return {pow(factor, gas_gamma / (gas_gamma - 1.0)) / gas_gamma, factor};
}

}  // namespace remodel::flow
