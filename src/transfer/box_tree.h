#pragma once

// Boxes in the plane, found by what they overlap or by how near they are.

#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/box.h"
#include "remodel/ids.h"
#include "remodel/point.h"

namespace remodel {

inline Box box_of(Point a, Point b, Point c) {
  Box box;
  for (const Point p : {a, b, c}) box.add(p);
  return box;
}

// A balanced binary tree over the boxes in the order of their centres along a Z curve. Node k has the
// children 2k + 1 and 2k + 2, which halve its boxes.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes) : order_(z_order(boxes)) {
    boxes_.reserve(boxes.size());
    for (const std::uint32_t box : order_) boxes_.push_back(boxes[box]);
    if (!boxes_.empty()) build(0, 0, boxes_.size());
  }

  // visit(box number), of the boxes that overlap, in no order of their numbers.
  template <class Visit>
  void for_each(const Box& box, Visit visit) const {
    if (!boxes_.empty()) for_each(0, 0, order_.size(), box, visit);
  }
  struct Nearest {
    std::uint32_t box = no_index;
    double distance = std::numeric_limits<double>::infinity();  // squared
  };
  // The box with the least squared distance(box number), the first of several, where that is less than the
  // one given. Precondition: no distance is less than that to the box.
  template <class Distance>
  Nearest nearest(Point p, Distance distance, Nearest best) const {
    if (!boxes_.empty()) nearest(0, 0, order_.size(), p, distance, best);
    return best;
  }

 private:
  static constexpr std::size_t leaf = 6;
  static std::vector<std::uint32_t> z_order(const std::vector<Box>& boxes);

  Box build(std::size_t node, std::size_t begin, std::size_t end) {
    if (node >= nodes_.size()) nodes_.resize(2 * node + 1);
    Box box;
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i) box.add(boxes_[i]);
    } else {
      const std::size_t middle = begin + (end - begin) / 2;
      box.add(build(2 * node + 1, begin, middle));
      box.add(build(2 * node + 2, middle, end));
    }
    return nodes_[node] = box;
  }

  template <class Visit>
  void for_each(std::size_t node, std::size_t begin, std::size_t end, const Box& box, Visit& visit) const {
    if (!nodes_[node].overlaps(box)) return;
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i)
        if (boxes_[i].overlaps(box)) visit(order_[i]);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    for_each(2 * node + 1, begin, middle, box, visit);
    for_each(2 * node + 2, middle, end, box, visit);
  }

  template <class Distance>
  void nearest(std::size_t node, std::size_t begin, std::size_t end, Point p, Distance& distance,
               Nearest& best) const {
    if (nodes_[node].squared_distance(p) > best.distance) return;
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i) {
        if (boxes_[i].squared_distance(p) > best.distance) continue;
        const double d = distance(order_[i]);
        if (d < best.distance || (d == best.distance && order_[i] < best.box)) best = {order_[i], d};
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2, left = 2 * node + 1, right = left + 1;
    const bool left_first = nodes_[left].squared_distance(p) <= nodes_[right].squared_distance(p);
    if (left_first) nearest(left, begin, middle, p, distance, best);
    nearest(right, middle, end, p, distance, best);
    if (!left_first) nearest(left, begin, middle, p, distance, best);
  }

  std::vector<std::uint32_t> order_;  // numbers of boxes along the curve
  std::vector<Box> boxes_;            // in that order
  std::vector<Box> nodes_;
};

}  // namespace remodel
