#include "transfer/halves.h"

#include <algorithm>
#include <map>
#include <string>

#include "remodel/error.h"
#include "remodel/ids.h"

namespace remodel {

namespace {

void require_multiple(std::size_t found, std::size_t cells, int components) {
  const std::size_t expected = cells * static_cast<std::size_t>(components);
  if (components >= 1 && found == expected) return;
  throw Error(ErrorCode::argument, "values",
              "found " + std::to_string(found) + ", expected " + std::to_string(expected) + ": " +
                  std::to_string(components) + " for each of " + std::to_string(cells));
}

}  // namespace

Halves::Halves(const FrozenMesh& mesh, const char* which) : triangles_(mesh.triangles.size()) {
  for (const auto& quad : mesh.quads)
    if (*std::max_element(quad.begin(), quad.end()) >= mesh.points.size())
      throw Error(ErrorCode::argument, which, "found arrays of different sizes, expected one value a point");
  if (mesh.quads.empty()) return;
  split_ = with_split_quads(mesh);
  const auto area = [&](std::size_t t) {
    const auto& [a, b, c] = split_.triangles[t];
    return cross(split_.points[b] - split_.points[a], split_.points[c] - split_.points[a]);
  };
  for (std::size_t t = triangles_; t < split_.triangles.size(); t += 2) {
    const double first = area(t), both = first + area(t + 1);
    const double share = both > 0.0 ? std::clamp(first / both, 0.0, 1.0) : 0.5;
    share_.insert(share_.end(), {share, 1.0 - share});
  }
}

std::uint32_t Halves::cell_of(std::uint32_t triangle) const {
  if (triangle < triangles_ || !any()) return triangle;
  return static_cast<std::uint32_t>(triangles_ + (triangle - triangles_) / 2);
}

std::vector<double> Halves::to_triangles(const std::vector<double>& values, int components) const {
  if (!any()) return values;
  require_multiple(values.size(), cells(), components);
  const auto width = static_cast<std::ptrdiff_t>(components);
  const auto own = static_cast<std::ptrdiff_t>(triangles_) * width;
  std::vector<double> result(values.begin(), values.begin() + own);
  for (auto quad = values.begin() + own; quad != values.end(); quad += width)
    for (int half = 0; half < 2; ++half) result.insert(result.end(), quad, quad + width);
  return result;
}

// Where both halves have one value it stays, to the last bit.
std::vector<double> Halves::to_cells(const std::vector<double>& values, int components) const {
  if (!any()) return values;
  const auto width = static_cast<std::size_t>(components);
  std::vector<double> result(values.begin(),
                             values.begin() + static_cast<std::ptrdiff_t>(triangles_ * width));
  for (std::size_t half = 0; half < share_.size(); half += 2)
    for (std::size_t k = 0; k < width; ++k) {
      const double first = values[(triangles_ + half) * width + k];
      const double second = values[(triangles_ + half + 1) * width + k];
      result.push_back(first == second ? first : share_[half] * first + share_[half + 1] * second);
    }
  return result;
}

ValueMap map_of_cells(const ValueMap& map, const Halves& before, const Halves& after) {
  const std::size_t size = after.any() ? after.cells() : map.size_after;
  ValueMap result;
  result.size_before = before.any() ? before.cells() : map.size_before;
  result.size_after = size;
  result.same.assign(size, no_index);
  result.starts.push_back(0);
  std::size_t row = 0;
  std::uint32_t half = 0;
  for (std::uint32_t cell = 0; cell < size; ++cell) {
    std::map<std::uint32_t, double> parts;
    bool same = true;
    for (; half < map.size_after && after.cell_of(half) == cell; ++half) {
      const bool split = after.any() && half >= after.triangles_;
      const double share = split ? after.share_[half - after.triangles_] : 1.0;
      if (row < map.rows.size() && map.rows[row] == half) {
        same = false;
        for (std::uint32_t i = map.starts[row]; i < map.starts[row + 1]; ++i)
          parts[before.cell_of(map.parts[i].from)] += share * map.parts[i].weight;
        ++row;
      } else if (map.same[half] != no_index) {
        parts[before.cell_of(map.same[half])] += share;
      }
    }
    if (same && parts.size() == 1) {
      result.same[cell] = parts.begin()->first;
      continue;
    }
    result.rows.push_back(cell);
    for (const auto& [from, weight] : parts) result.parts.push_back({from, weight});
    result.starts.push_back(static_cast<std::uint32_t>(result.parts.size()));
  }
  return result;
}

}  // namespace remodel
