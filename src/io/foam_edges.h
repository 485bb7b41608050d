#pragma once

// The edges of a mesh that become faces of patches.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel::io {

// An edge of a cell; the cell is on its left.
struct FoamEdge {
  std::uint32_t a, b;
  std::uint32_t cell;

  std::array<std::uint32_t, 2> ends() const { return {std::min(a, b), std::max(a, b)}; }
};

struct FoamPatch {
  std::string name;
  std::vector<FoamEdge> edges;  // in the order of the boundary
};

// All edges of all cells, the two of one edge side by side.
inline std::vector<FoamEdge> edges_of_cells(const FrozenMesh& mesh) {
  std::vector<FoamEdge> edges;
  edges.reserve(3 * mesh.triangles.size() + 4 * mesh.quads.size());
  for (std::uint32_t i = 0; i < mesh.cell_count(); ++i) {
    const auto corners = mesh.cell(i);
    for (std::size_t k = 0; k < corners.size(); ++k)
      edges.push_back({corners[k], corners[(k + 1) % corners.size()], i});
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const FoamEdge& a, const FoamEdge& b) { return a.ends() < b.ends(); });
  return edges;
}

// Boundaries with cells on one side, by name, see as_word(); what no boundary names has the name "unnamed".
std::vector<FoamPatch> foam_patches(const FrozenMesh& mesh, const std::vector<FoamEdge>& edges);

}  // namespace remodel::io
