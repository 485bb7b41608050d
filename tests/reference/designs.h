#pragma once

// Random designs for tests: an airfoil of the catalogue with every coefficient multiplied by 1 + sigma *
// noise.

#include <cmath>
#include <random>

#include "remodel/airfoil.h"

namespace remodel::test {

// Approximately normal: the sum of twelve uniform values, the same on every machine.
inline double noise(std::mt19937_64& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
  return sum;
}

inline CstAirfoil random_design(std::mt19937_64& random, double sigma) {
  const auto& catalogue = airfoil_catalogue();
  for (;;) {
    CstAirfoil airfoil = catalogue[random() % catalogue.size()].airfoil();
    for (auto* side : {&airfoil.upper, &airfoil.lower})
      for (double& value : *side) value *= 1.0 + sigma * noise(random);
    if (surfaces_apart(airfoil)) return airfoil;
  }
}

inline CstAirfoil random_variant(std::mt19937_64& random, const CstAirfoil& of, double sigma) {
  for (;;) {
    CstAirfoil airfoil = of;
    for (auto* side : {&airfoil.upper, &airfoil.lower})
      for (double& value : *side) value *= 1.0 + sigma * noise(random);
    if (surfaces_apart(airfoil)) return airfoil;
  }
}

}  // namespace remodel::test
