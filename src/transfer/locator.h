#pragma once

// Places in the triangulation before.

#include <optional>
#include <vector>

#include "remodel/transfer.h"
#include "transfer/box_tree.h"
#include "transfer/patches.h"

namespace remodel {

struct Place {
  std::uint32_t triangle = no_index;  // number in PatchSide::triangles
  std::array<double, 3> weights{};    // of its corners; they add up to 1
  double distance = 0.0;              // to the old domain: 0 within
};

bool holds(const Corners& t, Point p);
// weights_at() of a point within: rounding leaves none below 0.
std::array<double, 3> clamped_weights_at(const Corners& t, Point p);

class Locator {
 public:
  // Of the first triangles of a side, which stay where they are in it.
  Locator(const PatchSide& side, std::size_t count) : side_(side) { extend(count); }
  // To more of its first triangles.
  void extend(std::size_t count);

  // Where p lies, in the first triangle of several.
  std::optional<Place> within(Point p) const;
  // By the nearest triangle. Throws Error (argument) where that is refused, or there is no triangle.
  Place beyond(Point p, Outside outside) const;
  Place locate(Point p, Outside outside) const;  // one of the two
  // The triangles whose boxes overlap a triangle's, ascending.
  void find(const Corners& corners, std::vector<std::uint32_t>& found) const;

 private:
  struct Part {
    std::uint32_t first;  // triangle of its tree
    BoxTree tree;
  };

  const PatchSide& side_;
  std::vector<Part> parts_;
  std::size_t count_ = 0;
};

// Of vertices, since a moment.
ValueMap vertex_map_since(const Moment& moment, Outside outside);

}  // namespace remodel
