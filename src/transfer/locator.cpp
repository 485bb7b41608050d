#include "transfer/locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/in_triangle.h"
#include "remodel/error.h"
#include "remodel/predicates.h"

namespace remodel {

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

void Locator::extend(std::size_t count) {
  std::vector<Box> boxes;
  boxes.reserve(count - count_);
  for (std::size_t t = count_; t < count; ++t) {
    const Corners corners = side_.corners(t);
    boxes.push_back(box_of(corners[0], corners[1], corners[2]));
  }
  parts_.push_back({static_cast<std::uint32_t>(count_), BoxTree(boxes)});
  count_ = count;
}

std::optional<Place> Locator::within(Point p) const {
  Box box;
  box.add(p);
  std::uint32_t found = no_index;
  for (const Part& part : parts_) {
    part.tree.for_each(box, [&](std::uint32_t i) {
      const std::uint32_t t = part.first + i;
      if (t < found && holds(side_.corners(t), p)) found = t;
    });
    if (found != no_index) return Place{found, clamped_weights_at(side_.corners(found), p), 0.0};
  }
  return std::nullopt;
}

Place Locator::beyond(Point p, Outside outside) const {
  const auto on_edges = [&](std::uint32_t t) { return nearest_on_edges(side_.corners(t), p); };
  std::uint32_t t = no_index;
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    const BoxTree::Nearest nearest = part.tree.nearest(
        p, [&](std::uint32_t i) { return squared_distance(p, on_edges(part.first + i)); }, {no_index, least});
    if (nearest.distance < least) t = part.first + nearest.box, least = nearest.distance;
  }
  if (t == no_index || outside == Outside::refuse)
    throw Error(ErrorCode::argument, "transfer",
                "found (" + std::to_string(p.x) + ", " + std::to_string(p.y) + ") " +
                    (t == no_index ? "far from all old triangles"
                                   : "beyond the old domain, expected a place within"));
  const Corners corners = side_.corners(t);
  const Point q = nearest_on_edges(corners, p);
  return {t, outside == Outside::extrapolate ? weights_at(corners, p) : clamped_weights_at(corners, q),
          std::sqrt(least)};
}

Place Locator::locate(Point p, Outside outside) const {
  const std::optional<Place> found = within(p);
  return found ? *found : beyond(p, outside);
}

void Locator::find(const Corners& corners, std::vector<std::uint32_t>& found) const {
  found.clear();
  const Box box = box_of(corners[0], corners[1], corners[2]);
  for (const Part& part : parts_)
    part.tree.for_each(box, [&](std::uint32_t i) { found.push_back(part.first + i); });
  std::sort(found.begin(), found.end());
}

}  // namespace remodel
