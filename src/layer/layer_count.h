#pragma once

// What of an earlier layer is left in a later one, and which columns are the same.

#include <cstdint>
#include <vector>

#include "layer/layer_parts.h"

namespace remodel {

// The columns of a station are the same where its fan has as many sectors as before.
ColumnMatches match_columns(const FanSectors& before, const FanSectors& now,
                            const std::vector<std::size_t>& old_ring);
// By their numbers.
ColumnMatches match_columns(const std::vector<std::vector<std::uint32_t>>& before,
                            const std::vector<std::vector<std::uint32_t>>& now);

struct LayerCounts {
  std::size_t before = 0, now = 0, preserved = 0, connected = 0;  // cells
  std::size_t moved = 0, inserted = 0, removed = 0;               // vertices below the tops
};
LayerCounts count_layer(const LayerColumns& was, const std::vector<RingTops>& tops_before,
                        const LayerColumns& is, const std::vector<RingTops>& tops_now,
                        const ColumnMatches& matches, std::uint32_t levels);

// Whether a column stands on the foot of the one before it: both are of one fan.
bool shares_foot(const ColumnRing& ring, std::size_t column);

}  // namespace remodel
