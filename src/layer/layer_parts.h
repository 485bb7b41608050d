#pragma once

// What a layered mesh is made of, for the files of this layer that make, change, show and measure it.

#include <vector>

#include "layer/columns.h"
#include "remodel/layers.h"

namespace remodel {

struct LayeredMesh::Columns : LayerColumns {
  std::vector<std::size_t> loops;  // that have a layer, as rings are
  FanSectors fans;
  std::uint32_t levels = 0;
  std::uint32_t epoch = 0;  // of the vertices' keys: how often columns were set up anew

  std::size_t count() const {
    std::size_t columns = 0;
    for (const ColumnRing& ring : rings) columns += ring.size();
    return columns;
  }
};

// The vertices of the outer mesh on the tops of one ring.
struct RingTops {
  struct Split {
    VertexKey key;
    Point point;
    friend bool operator==(const Split&, const Split&) = default;
  };
  std::vector<VertexId> top;                // per column
  std::vector<std::vector<Split>> splits;  // per column: Steiner vertices from its top to the next one's, in order
};
std::vector<RingTops> tops_of(const Mesh& outer, const LayerColumns& columns);

// Cells of a ring's layer, divided top cells by their triangles.
std::size_t cell_count(const ColumnRing& ring, const RingTops& tops, std::uint32_t levels);
// The triangles of a divided top cell.
std::size_t parts_of_split(const ColumnRing& ring, std::size_t column, std::size_t splits, std::uint32_t levels);

}  // namespace remodel
