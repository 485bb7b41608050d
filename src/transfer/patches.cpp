#include "transfer/patches.h"

#include <algorithm>
#include <utility>

namespace remodel {

namespace {

// A triangle by its corners, beginning with the least.
PatchBuilder::Triple turned(PatchBuilder::Triple corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

// The triangles of before come first where they are changed: what stays the same moves behind them.
void PatchBuilder::match_triangles() {
  PatchSide &before = patches_.before, &after = patches_.after;
  for (std::size_t v = 0; v < after.points.size(); ++v) {
    const std::uint32_t old = patches_.same_vertex[v];
    patches_.at_rest.push_back(old != no_index && before.points[old] == after.points[v]);
  }
  patches_.area_at_rest.assign(after.points.size(), 0.0);
  // Of each vertex the last triangle whose least corner it is, and of each triangle the one before.
  std::vector<std::uint32_t> last(before.points.size(), no_index), previous;
  for (std::uint32_t t = 0; t < before.triangles.size(); ++t) {
    before.triangles[t].corners = turned(before.triangles[t].corners);
    previous.push_back(std::exchange(last[before.triangles[t].corners[0]], t));
  }

  std::vector<bool> rests(before.triangles.size(), false);
  std::vector<PatchSide::Triangle> changed;
  std::vector<std::uint32_t> same;
  for (const PatchSide::Triangle& triangle : after.triangles) {
    std::uint32_t found = no_index;
    Triple corners;
    bool there = true, at_rest = true;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = patches_.same_vertex[triangle.corners[k]];
      there = there && corners[k] != no_index;
      at_rest = at_rest && patches_.at_rest[triangle.corners[k]];
    }
    if (there) {
      corners = turned(corners);
      found = last[corners[0]];
      while (found != no_index && before.triangles[found].corners != corners) found = previous[found];
    }
    if (found != no_index && at_rest) {
      rests[found] = true;
      if (before.triangles[found].number != triangle.number)
        patches_.renumbered.emplace_back(before.triangles[found].number, triangle.number);
      const double third = area_of(after.corners(triangle)) / 3.0;
      for (const std::uint32_t v : triangle.corners) patches_.area_at_rest[v] += third;
      continue;
    }
    changed.push_back(triangle);
    same.push_back(found);
  }
  after.triangles = std::move(changed);

  std::vector<PatchSide::Triangle> ordered, resting;
  std::vector<std::uint32_t> place(before.triangles.size());
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    if (rests[t]) {
      resting.push_back(before.triangles[t]);
    } else {
      place[t] = static_cast<std::uint32_t>(ordered.size());
      ordered.push_back(before.triangles[t]);
    }
  }
  patches_.changed = ordered.size();
  ordered.insert(ordered.end(), resting.begin(), resting.end());
  before.triangles = std::move(ordered);
  for (const std::uint32_t t : same) patches_.same_triangle.push_back(t == no_index ? no_index : place[t]);
}

}  // namespace remodel
