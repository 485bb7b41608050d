#pragma once

// Columns of a domain's walls: their heights, directions and points, valid by exact predicates.

#include <cstdint>
#include <vector>

#include "layer/rings.h"
#include "remodel/domain.h"
#include "remodel/layers.h"

namespace remodel {

struct LayerColumns {
  std::vector<ColumnRing> rings;
  std::size_t shrunk = 0;  // columns that had to give way
};

// The columns of these walls: a function of its arguments alone. Throws Error (geometry), with the place,
// where they cannot be made valid.
LayerColumns columns_of(const Walls& walls, const std::vector<LayeredWall>& layered,
                        const FanSectors& sectors, const LayerOptions& options, std::uint32_t levels);

// The cell at a level, 0 the one at the wall, between a column that has a next one and that,
// counter-clockwise. Where the two are of one fan, the first cell is a triangle, and corners 0 and 1 are the
// same point.
struct CellPoints {
  Point corner[4];
  bool triangle = false;
};
CellPoints layer_cell(const ColumnRing& ring, std::size_t column, std::uint32_t level, std::uint32_t levels);
// Strictly convex and counter-clockwise, exactly decided.
bool is_convex(const CellPoints& cell);

}  // namespace remodel
