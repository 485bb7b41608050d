#pragma once

// Sets of numbers from 0 that are joined, each with one of its numbers for a root (R. E. Tarjan and
// J. van Leeuwen, J. ACM 31, 1984: paths are halved).

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace remodel {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The root of `into` becomes that of both.
  void join(std::uint32_t i, std::uint32_t into) { parent_[root(i)] = root(into); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace remodel
