#include "aero/boundary_pieces.h"

#include <map>
#include <set>

namespace remodel {

std::vector<std::vector<std::uint32_t>> boundary_pieces(const FrozenBoundary& boundary) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::set<std::uint32_t> within;
  for (const auto& [from, to] : boundary.edges) next[from] = to, within.insert(to);
  std::vector<std::vector<std::uint32_t>> pieces;
  const auto follow = [&](std::uint32_t v) {
    if (!next.contains(v)) return;
    pieces.push_back({v});
    for (auto at = next.find(v); at != next.end(); at = next.find(pieces.back().back())) {
      pieces.back().push_back(at->second);
      next.erase(at);
    }
  };
  for (const auto& [from, to] : boundary.edges)
    if (!within.contains(from)) follow(from);  // where an open piece begins
  for (const auto& [from, to] : boundary.edges) follow(from);
  return pieces;
}

}  // namespace remodel
