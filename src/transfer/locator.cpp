#include "transfer/locator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "remodel/error.h"
#include "remodel/predicates.h"

namespace remodel {

namespace {

BoxTree tree_of(const PatchSide& side, std::size_t count) {
  std::vector<Box> boxes;
  boxes.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Corners corners = side.corners(t);
    boxes.push_back(box_of(corners[0], corners[1], corners[2]));
  }
  return BoxTree(std::move(boxes));
}

bool holds(const Corners& t, Point p) {
  return orient2d(t[0], t[1], p) >= 0 && orient2d(t[1], t[2], p) >= 0 && orient2d(t[2], t[0], p) >= 0;
}

// Rounding may leave the corners of a triangle that holds p a little below 0.
std::array<double, 3> within_bounds(std::array<double, 3> weights) {
  double sum = 0.0;
  for (double& w : weights) w = std::max(w, 0.0), sum += w;
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace

Locator::Locator(const Patches& patches)
    : patches_(patches),
      changed_(tree_of(patches.before, patches.changed)),
      all_(tree_of(patches.before, patches.before.triangles.size())) {}

Place Locator::locate(Point p, Outside outside) const {
  Box box;
  box.add(p);
  all_.find(box, found_);
  for (const std::uint32_t t : found_) {
    const Corners corners = patches_.before.corners(t);
    if (holds(corners, p)) return {t, within_bounds(weights_at(corners, p)), 0.0};
  }
  return beyond(p, outside);
}

Place Locator::beyond(Point p, Outside outside) const {
  const auto on_edges = [&](std::uint32_t t) { return nearest_on_edges(patches_.before.corners(t), p); };
  const std::uint32_t t = all_.nearest(p, [&](std::uint32_t i) { return squared_distance(p, on_edges(i)); });
  const std::string place = "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
  if (t == no_index)
    throw Error(ErrorCode::argument, "transfer", "found " + place + " far from all old triangles");
  const Point q = on_edges(t);
  if (outside == Outside::refuse)
    throw Error(ErrorCode::argument, "transfer",
                "found " + place + " beyond the old domain, expected a place within");
  const Corners corners = patches_.before.corners(t);
  const double distance = std::sqrt(squared_distance(p, q));
  if (outside == Outside::extrapolate) return {t, weights_at(corners, p), distance};
  return {t, within_bounds(weights_at(corners, q)), distance};
}

const std::vector<std::uint32_t>& Locator::candidates(const Corners& corners) const {
  changed_.find(box_of(corners[0], corners[1], corners[2]), found_);
  return found_;
}

}  // namespace remodel
