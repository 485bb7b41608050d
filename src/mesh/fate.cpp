#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>

#include "remodel/error.h"
#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel {
namespace {

bool has_names(const FrozenMesh& mesh) {
  const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size();
  return mesh.vertex_ids.size() == points && mesh.curve.size() == points && mesh.parameter.size() == points &&
         mesh.triangle_ids.size() == triangles && mesh.birth.size() == triangles;
}

bool carries_keys(const FrozenMesh& mesh) {
  return mesh.vertex_keys.size() == mesh.points.size();
}

// How vertices are called: by their ids, or where a mesh has layers by their keys alone.
enum class NamedBy { ids, keys };

NamedBy named_by(const FrozenMesh& before, const FrozenMesh& after) {
  if (has_names(before) && has_names(after)) return NamedBy::ids;
  if (carries_keys(before) && carries_keys(after)) return NamedBy::keys;
  throw Error(ErrorCode::argument, "fate", "a mesh without ids and births found, a native one expected");
}

std::uint64_t name_of(const FrozenMesh& mesh, std::uint32_t point, NamedBy named) {
  return named == NamedBy::ids ? mesh.vertex_ids[point] : mesh.vertex_keys[point];
}

// The three or four points of a cell by number, from the one with the least id on, so that one cell is
// written in one way. The fourth of a triangle is no_index.
using NamedCorners = std::array<std::uint32_t, 4>;
NamedCorners from_least_id(const FrozenMesh& mesh, std::size_t cell, NamedBy named) {
  const auto points = mesh.cell(cell);
  NamedCorners corners{0, 0, 0, no_index};
  std::copy(points.begin(), points.end(), corners.begin());
  const auto end = corners.begin() + static_cast<std::ptrdiff_t>(points.size());
  const auto least = std::min_element(corners.begin(), end, [&](std::uint32_t a, std::uint32_t b) {
    return name_of(mesh, a, named) < name_of(mesh, b, named);
  });
  std::rotate(corners.begin(), least, end);
  return corners;
}

// Cells of layers have no ids of their own.
bool has_id(const FrozenMesh& mesh, std::size_t cell, NamedBy named) {
  return named == NamedBy::ids && cell >= mesh.layer_triangles && cell < mesh.triangles.size();
}

// The state before, by the names of its cells and of their vertices.
class Earlier {
 public:
  Earlier(const FrozenMesh& mesh, NamedBy named) : mesh_(mesh), named_(named) {
    for (std::uint32_t i = 0; i < mesh.cell_count(); ++i) {
      if (has_id(mesh, i, named)) births_.emplace(mesh.triangle_ids[i], mesh.birth[i]);
      first_ids_.emplace(name_of(mesh, from_least_id(mesh, i, named)[0], named), i);
    }
  }

  bool has(std::uint32_t triangle_id, std::uint32_t birth) const {
    const auto found = births_.find(triangle_id);
    return found != births_.end() && found->second == birth;
  }

  // Those of the cell that joins the same vertices, nothing if there is none.
  std::optional<NamedCorners> joined(const FrozenMesh& after, const NamedCorners& corners) const {
    const auto [begin, end] = first_ids_.equal_range(name_of(after, corners[0], named_));
    for (auto entry = begin; entry != end; ++entry) {
      const NamedCorners old = from_least_id(mesh_, entry->second, named_);
      bool same = (old[3] == no_index) == (corners[3] == no_index);
      for (std::size_t k = 0; same && k < 4 && corners[k] != no_index; ++k)
        same = same_vertex(old[k], after, corners[k]);
      if (same) return old;
    }
    return std::nullopt;
  }

  bool rests(const NamedCorners& old, const FrozenMesh& after, const NamedCorners& corners) const {
    for (std::size_t k = 0; k < 4 && corners[k] != no_index; ++k)
      if (mesh_.points[old[k]] != after.points[corners[k]]) return false;
    return true;
  }

 private:
  // By keys, which are never given out again. Without them what has another place in the interior counts as
  // another vertex with the same id.
  bool same_vertex(std::uint32_t p, const FrozenMesh& after, std::uint32_t q) const {
    if (named_ == NamedBy::keys) return mesh_.vertex_keys[p] == after.vertex_keys[q];
    if (mesh_.vertex_ids[p] != after.vertex_ids[q] || mesh_.curve[p] != after.curve[q]) return false;
    if (mesh_.curve[p] < 0 && carries_keys(mesh_) && carries_keys(after))
      return mesh_.vertex_keys[p] == after.vertex_keys[q];
    return mesh_.curve[p] < 0 ? mesh_.points[p] == after.points[q] : mesh_.parameter[p] == after.parameter[q];
  }

  const FrozenMesh& mesh_;
  NamedBy named_;
  std::unordered_map<std::uint32_t, std::uint32_t> births_;  // by triangle id
  std::unordered_multimap<std::uint64_t, std::uint32_t>
      first_ids_;  // cells, by the least name of their vertices
};

}  // namespace

std::vector<Fate> fates(const FrozenMesh& before, const FrozenMesh& after) {
  const NamedBy names = named_by(before, after);
  const Earlier earlier(before, names);
  std::vector<Fate> result;
  result.reserve(after.cell_count());
  for (std::size_t i = 0; i < after.cell_count(); ++i) {
    const bool named = has_id(after, i, names);
    if (named && earlier.has(after.triangle_ids[i], after.birth[i])) {
      result.push_back(Fate::kept);
      continue;
    }
    const NamedCorners corners = from_least_id(after, i, names);
    const std::optional<NamedCorners> old = earlier.joined(after, corners);
    const bool kept = old && !named && earlier.rests(*old, after, corners);
    result.push_back(kept ? Fate::kept : old ? Fate::moved : Fate::made);
  }
  return result;
}

}  // namespace remodel
