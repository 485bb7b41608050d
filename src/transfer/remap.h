#pragma once

// Conservative transfer: docs/transfer.md.

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

// `map`: that of the ride, for what has not changed.
Balance remap_vertices(const RemapInput& input, const ValueMap& map, int components,
                       std::vector<double>& values);
Balance remap_triangles(const RemapInput& input, const ValueMap& map, int components,
                        std::vector<double>& values);

// Whether density and pressure are positive in a state whose components are named as in RemapOptions.
bool positive(const double* state, const std::array<int, 4>& conserved);

}  // namespace remodel
