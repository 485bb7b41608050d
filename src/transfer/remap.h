#pragma once

// Conservative transfer: docs/transfer.md.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "remodel/transfer.h"
#include "transfer/locator.h"
#include "transfer/patches.h"

namespace remodel {

struct RemapInput {
  const Patches& patches;
  const Locator& locator;
  Outside outside;
  const RemapOptions& options;
};

// The components as a size. Throws Error (argument) unless there are as many values for each of the numbers.
std::size_t require_values(const std::vector<double>& values, std::size_t numbers, int components);

// Runs a remap and puts what it has made into the values, after the map of what has not changed.
template <class Remap>
Balance remap_by(Remap&& remap, const ValueMap& map, int components, std::vector<double>& values) {
  Balance balance = remap.run();
  map.apply(values, components);
  remap.for_each_value([&](std::uint32_t number, const double* made) {
    const auto width = static_cast<std::size_t>(components);
    std::copy_n(made, width, values.begin() + static_cast<std::ptrdiff_t>(number * width));
  });
  return balance;
}

// `map`: that of the ride, for what has not changed.
Balance remap_vertices(const RemapInput& input, const ValueMap& map, int components,
                       std::vector<double>& values);
Balance remap_triangles(const RemapInput& input, const ValueMap& map, int components,
                        std::vector<double>& values);

// Whether density and pressure are positive in a state whose components are named as in RemapOptions.
bool positive(const double* state, const std::array<int, 4>& conserved);

}  // namespace remodel
