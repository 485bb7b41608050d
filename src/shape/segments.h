#pragma once

// Whether the sides of polygons and open chains meet anywhere but at their shared corners, decided exactly.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "remodel/point.h"

namespace remodel {

inline constexpr std::size_t no_side = std::numeric_limits<std::size_t>::max();

// A side of a closed polygon or of an open chain; `next` is the index of the side that begins where this one
// ends. from == to for a single point, which is both ends of its chain.
struct Side {
  Point from, to;
  std::size_t next = no_side;
  bool first = false;  // `from` is the end of a chain
  bool last() const { return next == no_side; }
};

struct SidePair {
  std::size_t first = 0;
  std::size_t second = 0;  // first < second
};

// Two sides that cross, touch or overlap, if there are any. Neighbours may share their corner and nothing
// else; an end of a chain may lie on corners of others. Polygons have at least three sides. Around n log n
// for sides that are listed polygon by polygon in order.
std::optional<SidePair> find_meeting_sides(std::span<const Side> sides);

// True where p is inside the closed polygon of these sides; p is on none of them.
bool is_inside(std::span<const Side> polygon, Point p);

}  // namespace remodel
