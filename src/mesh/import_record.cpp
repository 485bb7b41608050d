#include "mesh/import_record.h"

#include <algorithm>

#include "remodel/predicates.h"

namespace remodel {

namespace {

// The slots [begin, end) of the record are one face.
bool untouched(const MeshData& mesh, std::size_t begin, std::size_t end) {
  const Triangulation& triangulation = mesh.triangulation;
  const auto slots = mesh.imported.slots.begin();
  const auto in_face = [&](TriangleId t) {
    return std::binary_search(slots + static_cast<std::ptrdiff_t>(begin),
                              slots + static_cast<std::ptrdiff_t>(end), t.index);
  };
  for (std::size_t i = begin; i < end; ++i) {
    const Triangle& t = triangulation[TriangleId{mesh.imported.slots[i]}];
    if (!t.in_domain() || t.birth != 0) return false;
    for (const Link link : t.link)
      if (link.constrained() && in_face(link.triangle())) return false;
  }
  return true;
}

bool counterclockwise(const MeshData& mesh, std::size_t begin, std::size_t end) {
  const auto point = [&](std::size_t corner) {
    return mesh.triangulation.point(VertexId{mesh.imported.triangles[corner]});
  };
  for (std::size_t i = begin; i < end; ++i)
    if (orient2d(point(3 * i), point(3 * i + 1), point(3 * i + 2)) <= 0) return false;
  return true;
}

}  // namespace

std::unordered_map<std::uint32_t, std::array<std::uint32_t, 3>> triangles_as_imported(const MeshData& mesh) {
  const ImportRecord& record = mesh.imported;
  std::unordered_map<std::uint32_t, std::array<std::uint32_t, 3>> result;
  for (std::size_t begin = 0, end = 0; begin < record.slots.size(); begin = end) {
    while (end < record.slots.size() && record.faces[end] == record.faces[begin]) ++end;
    if (!untouched(mesh, begin, end) || !counterclockwise(mesh, begin, end)) continue;
    for (std::size_t i = begin; i < end; ++i)
      result[record.slots[i]] = {record.triangles[3 * i], record.triangles[3 * i + 1],
                                 record.triangles[3 * i + 2]};
  }
  return result;
}

}  // namespace remodel
