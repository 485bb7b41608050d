#pragma once

// Whether the sides of closed polygons meet anywhere but at their shared corners, decided exactly.

#include <cstddef>
#include <optional>
#include <span>

#include "remodel/point.h"

namespace remodel {

// A side of a closed polygon, from != to; `next` is the index of the side that begins where this one ends.
struct Side {
  Point from, to;
  std::size_t next = 0;
};

struct SidePair {
  std::size_t first = 0;
  std::size_t second = 0;  // first < second
};

// Two sides that cross, touch or overlap, if there are any. Neighbours may share their corner and nothing
// else. Polygons have at least three sides. Around n log n for sides that are listed polygon by polygon in
// order.
std::optional<SidePair> find_meeting_sides(std::span<const Side> sides);

// True where p is inside the closed polygon of these sides; p is on none of them.
bool is_inside(std::span<const Side> polygon, Point p);

}  // namespace remodel
