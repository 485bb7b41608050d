#pragma once

// Slopes of values on triangles: at each the least squares of the differences to all that share a vertex.

#include <vector>

#include "transfer/patches.h"

namespace remodel {

// The triangles of a side by their vertices.
class Neighbours {
 public:
  explicit Neighbours(const PatchSide& side);
  // Of a triangle: those that share a vertex with it, ascending, without itself.
  const std::vector<std::uint32_t>& around(std::uint32_t triangle) const;

 private:
  const PatchSide& side_;
  std::vector<std::uint32_t> start_, of_vertex_;
  mutable std::vector<std::uint32_t> found_;
};

// The slope at a triangle is the sum of weights[i] * (value of around[i] - value here). Zeros where the
// neighbours' centroids do not determine one.
std::vector<Point> slope_weights(const PatchSide& side, std::uint32_t triangle,
                                 const std::vector<std::uint32_t>& around);

}  // namespace remodel
