#include "transfer/locator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/in_triangle.h"
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

}  // namespace

bool holds(const Corners& t, Point p) {
  return in_triangle(t[0], t[1], t[2], p);
}

std::array<double, 3> clamped_weights_at(const Corners& t, Point p) {
  std::array<double, 3> weights = weights_at(t, p);
  double sum = 0.0;
  for (double& w : weights) w = std::max(w, 0.0), sum += w;
  for (double& w : weights) w /= sum;
  return weights;
}

Locator::Locator(const PatchSide& side, std::size_t count) : side_(side), tree_(tree_of(side, count)) {}

std::optional<Place> Locator::within(Point p) const {
  Box box;
  box.add(p);
  std::vector<std::uint32_t> found;
  tree_.find(box, found);
  for (const std::uint32_t t : found) {
    const Corners corners = side_.corners(t);
    if (holds(corners, p)) return Place{t, clamped_weights_at(corners, p), 0.0};
  }
  return std::nullopt;
}

Place Locator::beyond(Point p, Outside outside) const {
  const auto on_edges = [&](std::uint32_t t) { return nearest_on_edges(side_.corners(t), p); };
  const std::uint32_t t = tree_.nearest(p, [&](std::uint32_t i) { return squared_distance(p, on_edges(i)); });
  const std::string place = "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
  if (t == no_index)
    throw Error(ErrorCode::argument, "transfer", "found " + place + " far from all old triangles");
  if (outside == Outside::refuse)
    throw Error(ErrorCode::argument, "transfer",
                "found " + place + " beyond the old domain, expected a place within");
  const Point q = on_edges(t);
  const Corners corners = side_.corners(t);
  return {t, outside == Outside::extrapolate ? weights_at(corners, p) : clamped_weights_at(corners, q),
          std::sqrt(squared_distance(p, q))};
}

Place Locator::locate(Point p, Outside outside) const {
  const std::optional<Place> found = within(p);
  return found ? *found : beyond(p, outside);
}

void Locator::find(const Corners& corners, std::vector<std::uint32_t>& found) const {
  tree_.find(box_of(corners[0], corners[1], corners[2]), found);
}

}  // namespace remodel
