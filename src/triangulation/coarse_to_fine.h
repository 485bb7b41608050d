#pragma once

// An order in which to insert points that follow each other along curves.

#include <cstddef>
#include <vector>

namespace remodel {

// Every other of the points so far missing, coarse to fine: 0, then n/2, n/4, 3n/4, and so on. In the order
// of the list each point would see, and refill, all of the triangles between the first points and the last.
// The nearest point before i that is in is i with its last bit cleared: i & (i - 1).
inline std::vector<std::size_t> coarse_to_fine(std::size_t n) {
  std::size_t stride = 1;
  while (stride < n) stride *= 2;
  std::vector<std::size_t> order{0};
  for (; stride > 1; stride /= 2)
    for (std::size_t i = stride / 2; i < n; i += stride) order.push_back(i);
  return order;
}

}  // namespace remodel
