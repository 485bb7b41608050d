#include <algorithm>
#include <array>
#include <unordered_map>

#include "remodel/error.h"
#include "remodel/frozen_mesh.h"

namespace remodel {
namespace {

void require_names(const FrozenMesh& mesh) {
  const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size();
  if (mesh.vertex_ids.size() == points && mesh.curve.size() == points && mesh.parameter.size() == points &&
      mesh.triangle_ids.size() == triangles && mesh.birth.size() == triangles)
    return;
  throw Error(ErrorCode::argument, "fate", "a mesh without ids and births found, a native one expected");
}

// The three points of a triangle by number, from the one with the least id on, so that one triangle is
// written in one way.
std::array<std::uint32_t, 3> from_least_id(const FrozenMesh& mesh, std::size_t triangle) {
  std::array<std::uint32_t, 3> corners = mesh.triangles[triangle];
  const auto least = std::min_element(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.vertex_ids[a] < mesh.vertex_ids[b];
  });
  std::rotate(corners.begin(), least, corners.end());
  return corners;
}

// The state before, by the names of its triangles and of their vertices.
class Earlier {
 public:
  explicit Earlier(const FrozenMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      births_.emplace(mesh.triangle_ids[i], mesh.birth[i]);
      first_ids_.emplace(mesh.vertex_ids[from_least_id(mesh, i)[0]], i);
    }
  }

  bool has(std::uint32_t triangle_id, std::uint32_t birth) const {
    const auto found = births_.find(triangle_id);
    return found != births_.end() && found->second == birth;
  }

  bool joins(const FrozenMesh& after, const std::array<std::uint32_t, 3>& corners) const {
    const auto [begin, end] = first_ids_.equal_range(after.vertex_ids[corners[0]]);
    return std::any_of(begin, end, [&](const auto& entry) {
      const std::array<std::uint32_t, 3> old = from_least_id(mesh_, entry.second);
      for (std::size_t k = 0; k < 3; ++k)
        if (!same_vertex(old[k], after, corners[k])) return false;
      return true;
    });
  }

 private:
  // By keys, which are never given out again. Without them what has another place in the interior counts as
  // another vertex with the same id.
  bool same_vertex(std::uint32_t p, const FrozenMesh& after, std::uint32_t q) const {
    if (mesh_.vertex_ids[p] != after.vertex_ids[q] || mesh_.curve[p] != after.curve[q]) return false;
    if (mesh_.curve[p] < 0 && has_keys(mesh_) && has_keys(after))
      return mesh_.vertex_keys[p] == after.vertex_keys[q];
    return mesh_.curve[p] < 0 ? mesh_.points[p] == after.points[q] : mesh_.parameter[p] == after.parameter[q];
  }

  static bool has_keys(const FrozenMesh& mesh) { return mesh.vertex_keys.size() == mesh.points.size(); }

  const FrozenMesh& mesh_;
  std::unordered_map<std::uint32_t, std::uint32_t> births_;          // by triangle id
  std::unordered_multimap<std::uint32_t, std::uint32_t> first_ids_;  // triangles, by their least vertex id
};

}  // namespace

std::vector<Fate> fates(const FrozenMesh& before, const FrozenMesh& after) {
  require_names(before);
  require_names(after);
  const Earlier earlier(before);
  std::vector<Fate> result;
  result.reserve(after.triangles.size());
  for (std::size_t i = 0; i < after.triangles.size(); ++i) {
    if (earlier.has(after.triangle_ids[i], after.birth[i])) {
      result.push_back(Fate::kept);
    } else {
      result.push_back(earlier.joins(after, from_least_id(after, i)) ? Fate::moved : Fate::made);
    }
  }
  return result;
}

}  // namespace remodel
