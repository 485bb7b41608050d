// What two meshes of one origin have in common.

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel {
namespace {

using CellCorners = std::array<std::uint32_t, 4>;                  // the fourth of a triangle is no_index
using Numbers = std::unordered_map<std::uint64_t, std::uint32_t>;  // points by key

bool has_keys(const FrozenMesh& mesh) {
  return mesh.vertex_keys.size() == mesh.points.size() && mesh.curve.size() == mesh.points.size() &&
         mesh.parameter.size() == mesh.points.size();
}

Numbers by_key(const FrozenMesh& mesh) {
  Numbers numbers;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) numbers.emplace(mesh.vertex_keys[v], v);
  return numbers;
}

bool share_interior(const FrozenMesh& mesh, const FrozenMesh& origin, const Numbers& of_origin) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto found = of_origin.find(mesh.vertex_keys[v]);
    if (found != of_origin.end() && mesh.curve[v] < 0 && origin.curve[found->second] < 0 &&
        mesh.points[v] == origin.points[found->second])
      return true;
  }
  return false;
}

// Of each point after, the same one before, or no_index.
std::vector<std::uint32_t> same_by_places(const FrozenMesh& before, const FrozenMesh& after) {
  std::map<std::pair<double, double>, std::uint32_t> places;
  for (std::uint32_t v = 0; v < before.points.size(); ++v)
    places.emplace(std::pair(before.points[v].x, before.points[v].y), v);
  std::vector<std::uint32_t> same;
  for (const Point p : after.points) {
    const auto found = places.find({p.x, p.y});
    same.push_back(found == places.end() ? no_index : found->second);
  }
  return same;
}

std::vector<std::uint32_t> same_vertices(const FrozenMesh& before, const FrozenMesh& after,
                                         const FrozenMesh& origin) {
  if (!has_keys(before) || !has_keys(after) || !has_keys(origin)) return same_by_places(before, after);
  const Numbers of_origin = by_key(origin), of_before = by_key(before);
  if (!share_interior(before, origin, of_origin)) return same_by_places(before, after);
  std::vector<std::uint32_t> same;
  for (std::size_t v = 0; v < after.points.size(); ++v) {
    const auto found = of_before.find(after.vertex_keys[v]);
    std::uint32_t old = found == of_before.end() ? no_index : found->second;
    // Where it rests, another number of its curve says that the domain has its loops in another order.
    const bool rests = old != no_index && before.points[old] == after.points[v] &&
                       (before.curve[old] < 0) == (after.curve[v] < 0);
    if (old != no_index && !rests &&
        (before.curve[old] != after.curve[v] ||
         (after.curve[v] >= 0 && before.parameter[old] != after.parameter[v]) ||
         (!of_origin.contains(after.vertex_keys[v]) && before.points[old] != after.points[v])))
      old = no_index;
    same.push_back(old);
  }
  return same;
}

CellCorners from_least(CellCorners corners) {
  const auto end = corners.end() - (corners.back() == no_index ? 1 : 0);
  std::rotate(corners.begin(), std::min_element(corners.begin(), end), end);
  return corners;
}

}  // namespace

InCommon in_common(const FrozenMesh& before, const FrozenMesh& after, const FrozenMesh& origin) {
  const std::vector<std::uint32_t> same = same_vertices(before, after, origin);
  InCommon result;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < same.size(); ++v) {
    if (same[v] == no_index) continue;
    ++kept;
    if (before.points[same[v]] != after.points[v]) ++result.moved;
  }
  result.inserted = after.points.size() - kept;
  result.removed = before.points.size() - kept;

  std::vector<CellCorners> old;
  for (const auto& [a, b, c] : before.triangles) old.push_back(from_least({a, b, c, no_index}));
  for (const auto& quad : before.quads) old.push_back(from_least(quad));
  std::sort(old.begin(), old.end());
  for (std::size_t i = 0; i < after.cell_count(); ++i) {
    const auto cell = after.cell(i);
    CellCorners corners{0, 0, 0, no_index};
    bool there = true, rests = true;
    for (std::size_t k = 0; k < cell.size(); ++k) {
      corners[k] = same[cell[k]];
      there = there && corners[k] != no_index;
      rests = rests && there && before.points[corners[k]] == after.points[cell[k]];
    }
    if (!there || !std::binary_search(old.begin(), old.end(), from_least(corners))) continue;
    ++result.connected;
    if (rests) ++result.preserved;
  }
  return result;
}

}  // namespace remodel
