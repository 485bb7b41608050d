#pragma once

// Seeded numbers for measurements: the same on every machine, unlike the distributions of <random>.

#include <cstddef>
#include <cstdint>
#include <random>

#include "remodel/point.h"

namespace remodel::bench {

class Seeded {
 public:
  explicit Seeded(std::uint64_t seed) : random_(seed) {}

  // From low, inclusive, to high, exclusive.
  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  Point point() {
    const double x = number(0.0, 1.0);
    return {x, number(0.0, 1.0)};
  }
  // Below the bound, which is far below 2^64.
  std::size_t index(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }
  bool coin() { return index(2) == 0; }

 private:
  std::mt19937_64 random_;
};

}  // namespace remodel::bench
