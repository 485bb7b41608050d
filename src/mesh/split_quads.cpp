#include "remodel/frozen_mesh.h"
#include "remodel/predicates.h"

namespace remodel {

namespace {

// The values of quadrilaterals, behind those of triangles, become those of two triangles each.
template <class Value>
void repeat_for_halves(std::vector<Value>& values, std::size_t triangles) {
  if (values.size() < triangles) return;
  std::vector<Value> split(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(triangles));
  for (std::size_t i = triangles; i < values.size(); ++i) split.insert(split.end(), 2, values[i]);
  values = std::move(split);
}

}  // namespace

FrozenMesh with_split_quads(const FrozenMesh& mesh) {
  FrozenMesh result = mesh;
  if (mesh.quads.empty()) return result;
  result.quads.clear();
  result.triangles.reserve(mesh.triangles.size() + 2 * mesh.quads.size());
  for (const auto& [a, b, c, d] : mesh.quads) {
    const auto turns_left = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      return orient2d(mesh.points[p], mesh.points[q], mesh.points[r]) > 0;
    };
    const bool first = turns_left(a, b, c) && turns_left(a, c, d);
    const bool second = !first && turns_left(b, c, d) && turns_left(b, d, a);
    result.triangles.push_back(second ? std::array{b, c, d} : std::array{a, b, c});
    result.triangles.push_back(second ? std::array{b, d, a} : std::array{a, c, d});
  }
  repeat_for_halves(result.region, mesh.triangles.size());
  repeat_for_halves(result.fate, mesh.triangles.size());
  result.triangle_ids.clear();
  result.birth.clear();
  result.gradation_error.clear();
  result.layer_triangles = 0;
  return result;
}

}  // namespace remodel
