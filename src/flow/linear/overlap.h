#pragma once

// The difference between a mesh and the one that factors belong to.

#include "flow/linear/block_matrix.h"
#include "remodel/ids.h"

namespace remodel::flow {

struct Overlap {
  std::vector<std::uint32_t> row_of;  // per vertex its row in the factors, no_index if it has none
  std::size_t rows = 0;               // of the factors
  std::vector<std::uint32_t> zone;    // vertices with other neighbours and two rings around them, ascending

  // These reorder values from vertices to rows, and back; 0 without a counterpart.
  template <std::size_t N>
  BlockVector<N> to_rows(const BlockVector<N>& x) const {
    BlockVector<N> result(rows);
    for (std::size_t v = 0; v < x.size(); ++v)
      if (row_of[v] != no_index) result[row_of[v]] = x[v];
    return result;
  }
  template <std::size_t N>
  BlockVector<N> to_vertices(const BlockVector<N>& x) const {
    BlockVector<N> result(row_of.size());
    for (std::size_t v = 0; v < result.size(); ++v)
      if (row_of[v] != no_index) result[v] = x[row_of[v]];
    return result;
  }
};

}  // namespace remodel::flow
