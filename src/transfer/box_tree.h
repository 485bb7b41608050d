#pragma once

// Boxes in the plane, found by what they overlap or by how near they are.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
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

// A balanced binary tree over the boxes' centres, halved along the longer side. Node k has the children
// 2k + 1 and 2k + 2.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    std::vector<Item> items;
    items.reserve(boxes_.size());
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) items.push_back({boxes_[i].low + boxes_[i].high, i});
    if (!boxes_.empty()) build(0, items);
    order_.reserve(items.size());
    for (const Item& item : items) order_.push_back(item.box);
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
  static constexpr std::size_t leaf = 6;
  struct Nearest {
    std::uint32_t box = no_index;
    double distance = std::numeric_limits<double>::infinity();
  };

  struct Item {
    Point centre;  // twice
    std::uint32_t box;
  };

  void build(std::size_t node, std::span<Item> items) {
    if (node >= nodes_.size()) nodes_.resize(2 * node + 1);
    Box box, centres;
    for (const Item& item : items) {
      box.add(boxes_[item.box]);
      centres.add(item.centre);
    }
    nodes_[node] = box;
    if (items.size() <= leaf) return;
    const std::size_t middle = items.size() / 2;
    const auto split = [&](auto coordinate) {
      std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(),
                       [&](const Item& a, const Item& b) {
                         const double x = coordinate(a.centre), y = coordinate(b.centre);
                         return x < y || (x == y && a.box < b.box);
                       });
    };
    if (centres.high.x - centres.low.x >= centres.high.y - centres.low.y)
      split([](Point p) { return p.x; });
    else
      split([](Point p) { return p.y; });
    build(2 * node + 1, items.first(middle));
    build(2 * node + 2, items.subspan(middle));
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
