#include "design/triangle_snapshot.h"

#include <algorithm>

namespace remodel {
namespace {

// visit(least id, the two that follow it counter-clockwise).
template <class Visit>
void for_each_from_least(const Triangulation& triangulation, Visit visit) {
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    const int k = static_cast<int>(std::min_element(t.vertex, t.vertex + 3) - t.vertex);
    visit(t.vertex[k].index, std::array{t.vertex[next3(k)].index, t.vertex[previous3(k)].index});
  });
}

}  // namespace

TriangleSnapshot::TriangleSnapshot(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  vertices_.resize(triangulation.vertex_slots());
  for (std::uint32_t i = 0; i < vertices_.size(); ++i)
    vertices_[i] = {triangulation.point(VertexId{i}), triangulation.generation(VertexId{i})};
  // Counting sort by the least id.
  first_.assign(vertices_.size() + 1, 0);
  for_each_from_least(triangulation, [&](std::uint32_t least, const auto&) { ++first_[least + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  others_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_from_least(triangulation,
                      [&](std::uint32_t least, const auto& others) { others_[next[least]++] = others; });
}

TriangleSnapshot::Common TriangleSnapshot::common_with(const MeshData& mesh) const {
  const Triangulation& triangulation = mesh.triangulation;
  const std::size_t slots = std::max(vertices_.size(), triangulation.vertex_slots());
  std::vector<bool> there(slots, false), still(slots, false);
  for (std::uint32_t i = 0; i < std::min(vertices_.size(), triangulation.vertex_slots()); ++i) {
    there[i] = vertices_[i].generation == triangulation.generation(VertexId{i});
    still[i] = there[i] && vertices_[i].point == triangulation.point(VertexId{i});
  }
  Common common;
  for_each_from_least(triangulation, [&](std::uint32_t least, const auto& others) {
    if (!there[least] || !there[others[0]] || !there[others[1]]) return;
    const auto begin = others_.begin() + first_[least], end = others_.begin() + first_[least + 1];
    if (std::find(begin, end, others) == end) return;
    ++common.joined;
    common.same += still[least] && still[others[0]] && still[others[1]];
  });
  return common;
}

}  // namespace remodel
