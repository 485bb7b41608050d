#include "transfer/box_tree.h"

#include <array>
#include <utility>

namespace remodel {

namespace {

constexpr int bits = 20;  // of each coordinate: a millionth of the boxes' extent

// The bits of x apart, with room for another's between them.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ffff0000ffff;
  x = (x | x << 8) & 0x00ff00ff00ff00ff;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
  x = (x | x << 2) & 0x3333333333333333;
  return (x | x << 1) & 0x5555555555555555;
}

struct Item {
  std::uint64_t place;  // along the curve
  std::uint32_t box;
};

// A stable sort by places, digit by digit.
void sort_by_place(std::vector<Item>& items) {
  constexpr int digit = 8, digits = 2 * bits / digit;
  constexpr std::size_t values = std::size_t{1} << digit;
  std::vector<Item> sorted(items.size());
  for (int d = 0; d < digits; ++d) {
    const auto value = [&](const Item& item) { return item.place >> (d * digit) & (values - 1); };
    std::array<std::uint32_t, values> next{};
    for (const Item& item : items) ++next[value(item)];
    std::uint32_t begin = 0;
    for (std::uint32_t& n : next) begin += std::exchange(n, begin);
    for (const Item& item : items) sorted[next[value(item)]++] = item;
    items.swap(sorted);
  }
}

}  // namespace

std::vector<std::uint32_t> BoxTree::z_order(const std::vector<Box>& boxes) {
  Box centres;  // twice
  for (const Box& box : boxes) centres.add(box.low + box.high);
  const auto scale = [](double low, double high) {
    return high > low ? ((1 << bits) - 1) / (high - low) : 0.0;
  };
  const double x_scale = scale(centres.low.x, centres.high.x), y_scale = scale(centres.low.y, centres.high.y);
  std::vector<Item> items;
  items.reserve(boxes.size());
  for (const Box& box : boxes) {
    const Point from_low = box.low + box.high - centres.low;
    const auto x = static_cast<std::uint64_t>(x_scale * from_low.x),
               y = static_cast<std::uint64_t>(y_scale * from_low.y);
    items.push_back({spread(x) | spread(y) << 1, static_cast<std::uint32_t>(items.size())});
  }
  sort_by_place(items);
  std::vector<std::uint32_t> order;
  order.reserve(items.size());
  for (const Item& item : items) order.push_back(item.box);
  return order;
}

}  // namespace remodel
