#include "flow/scheme/wall_chains.h"

#include <utility>

namespace remodel::flow {

std::vector<WallChain> wall_chains(const FlowMesh& mesh) {
  const std::vector<BoundaryEdge>& boundary = mesh.boundary();
  const auto is_wall = [&](const BoundaryEdge& edge) { return mesh.patch(edge).sticks(); };
  std::vector<std::uint32_t> next(mesh.size(), no_index);      // the edge that begins at a vertex
  std::vector<std::uint32_t> previous(mesh.size(), no_index);  // the one that ends there
  std::vector<bool> is_shared(mesh.size(), false);
  for (std::uint32_t e = 0; e < boundary.size(); ++e) {
    if (!is_wall(boundary[e])) continue;
    const auto [a, b] = std::pair(boundary[e].a, boundary[e].b);
    if (next[a] != no_index) is_shared[a] = true;
    if (previous[b] != no_index) is_shared[b] = true;
    next[a] = previous[b] = e;
  }
  for (std::size_t v = 0; v < mesh.size(); ++v)
    if (is_shared[v]) next[v] = previous[v] = no_index;

  std::vector<WallChain> chains;
  std::vector<bool> seen(boundary.size(), false);
  for (std::uint32_t edge = 0; edge < boundary.size(); ++edge) {
    if (seen[edge] || !is_wall(boundary[edge])) continue;
    std::uint32_t first = edge, e = previous[boundary[edge].a];
    for (; e != no_index && e != edge; e = previous[boundary[e].a]) first = e;
    WallChain& chain = chains.emplace_back(WallChain{.edges = {}, .closed = e == edge});
    for (e = first; e != no_index && !seen[e]; e = next[boundary[e].b])
      seen[e] = true, chain.edges.push_back(e);
  }
  return chains;
}

}  // namespace remodel::flow
