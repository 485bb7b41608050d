#pragma once

// Boxes in the plane, found by what they overlap or by how near they are.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "remodel/ids.h"
#include "remodel/point.h"

namespace remodel {

struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  bool overlaps(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
  double squared_distance(Point p) const {
    const double x = std::max({low.x - p.x, 0.0, p.x - high.x}),
                 y = std::max({low.y - p.y, 0.0, p.y - high.y});
    return x * x + y * y;
  }
};

inline Box box_of(Point a, Point b, Point c) {
  Box box;
  for (const Point p : {a, b, c}) box.add(p);
  return box;
}

// A balanced binary tree over the boxes' centres, halved along the longer side. Node k has the children
// 2k + 1 and 2k + 2.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!boxes_.empty()) build(0, 0, order_.size());
  }

  // The boxes that overlap, ascending.
  void find(const Box& box, std::vector<std::uint32_t>& found) const {
    found.clear();
    if (!boxes_.empty()) find(0, 0, order_.size(), box, found);
    std::sort(found.begin(), found.end());
  }

  // The box with the least squared distance(box number), the first of several; no_index if there is none.
  // Precondition: no distance is less than that to the box.
  template <class Distance>
  std::uint32_t nearest(Point p, Distance distance) const {
    Nearest best;
    if (!boxes_.empty()) nearest(0, 0, order_.size(), p, distance, best);
    return best.box;
  }

 private:
  static constexpr std::size_t leaf = 4;
  struct Nearest {
    std::uint32_t box = no_index;
    double distance = std::numeric_limits<double>::infinity();
  };

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    if (node >= nodes_.size()) nodes_.resize(node + 1);
    Box box, centres;
    for (std::size_t i = begin; i < end; ++i) {
      const Box& b = boxes_[order_[i]];
      box.add(b.low), box.add(b.high);
      centres.add(b.low + b.high);
    }
    nodes_[node] = box;
    if (end - begin <= leaf) return;
    const bool wide = centres.high.x - centres.low.x >= centres.high.y - centres.low.y;
    const auto centre = [&](std::uint32_t i) {
      const Point sum = boxes_[i].low + boxes_[i].high;
      return std::pair(wide ? sum.x : sum.y, i);
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
  }

  void find(std::size_t node, std::size_t begin, std::size_t end, const Box& box,
            std::vector<std::uint32_t>& found) const {
    if (!nodes_[node].overlaps(box)) return;
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i)
        if (boxes_[order_[i]].overlaps(box)) found.push_back(order_[i]);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    find(2 * node + 1, begin, middle, box, found);
    find(2 * node + 2, middle, end, box, found);
  }

  template <class Distance>
  void nearest(std::size_t node, std::size_t begin, std::size_t end, Point p, Distance& distance,
               Nearest& best) const {
    if (nodes_[node].squared_distance(p) > best.distance) return;
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i) {
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

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> nodes_;
};

}  // namespace remodel
