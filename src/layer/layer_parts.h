#pragma once

// What a layered mesh is made of, for the files of this layer that make, change, show and measure it.

#include <vector>

#include "layer/columns.h"
#include "remodel/layers.h"

namespace remodel {

struct LayeredMesh::Columns : LayerColumns {
  std::vector<LayeredWall> layered;  // that have a layer, as rings are
  FanSectors fans;
  std::uint32_t levels = 0;
  std::vector<std::vector<std::uint32_t>> ids;  // per ring and column: its number
  std::uint32_t next_id = 0;

  std::size_t count() const {
    std::size_t columns = 0;
    for (const ColumnRing& ring : rings) columns += ring.size();
    return columns;
  }
};

// Throws Error (argument) for options out of range.
void require_layer_options(const LayerOptions& options);

// Per ring and column of a layer: the place of the same column in an earlier layer, if it is one of that.
struct ColumnPlace {
  std::size_t ring = no_column, column = no_column;
  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);
  bool there() const { return column != no_column; }
};
using ColumnMatches = std::vector<std::vector<ColumnPlace>>;

// The vertices of the outer mesh on the tops of one ring.
struct RingTops {
  struct Split {
    VertexKey key;
    Point point;
    friend bool operator==(const Split&, const Split&) = default;
  };
  std::vector<VertexId> top;  // per column
  std::vector<std::vector<Split>>
      splits;  // per column: Steiner vertices from its top to the next one's, in order
};
std::vector<RingTops> tops_of(const Mesh& outer, const LayerColumns& columns);

// The key of the vertex of a column, by the column's number, at a level.
std::uint64_t layer_key(std::uint32_t column, std::uint32_t level, std::uint32_t levels);

// Cells of a ring's layer, divided top cells by their triangles.
std::size_t cell_count(const ColumnRing& ring, const RingTops& tops, std::uint32_t levels);
// The triangles of a divided top cell.
std::size_t parts_of_split(const ColumnRing& ring, std::size_t column, std::size_t splits,
                           std::uint32_t levels);

}  // namespace remodel
