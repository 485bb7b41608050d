#pragma once

// Designs that are all known before the first of them is meshed: samples of a parameter study, a database,
// the steps of finite differences. In what order they are meshed is free, and decides how much of a mesh
// survives from one to the next.

#include <cstddef>
#include <vector>

#include "remodel/airfoil.h"

namespace remodel {

enum class DesignDistance {
  // The largest distance between vertices that correspond, over the length scale of the vertex before:
  // what decides whether a mesh can be adjusted in place.
  displacement,
  // The Euclidean distance of the coefficients of both surfaces, the lower degree raised. All designs must
  // have the same class exponents.
  coefficients,
};

struct OrderOptions {
  DesignDistance distance = DesignDistance::displacement;
  int points = 200;  // displacement: vertices on an outline, as in AirfoilDomainOptions; even, at least 8
};

// The designs' indices as a nearest-neighbour chain: first the one that is nearest to `start`, then of those
// left always the one nearest to the last; of several the first. Takes time in proportion to the square of
// their number: about a second for two thousand. Throws Error (argument).
std::vector<std::size_t> order_designs(const CstAirfoil& start, const std::vector<CstAirfoil>& designs,
                                       const OrderOptions& options = {});

}  // namespace remodel
