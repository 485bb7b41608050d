#pragma once

// How far apart two designs are for a mesh. Whether all boundary vertices can be moved in place depends on
// how far they move against the size of the triangles there: the *displacement* between two designs is the
// largest distance between vertices that correspond, over the length scale of the first design's.

#include <vector>

#include "remodel/point.h"

namespace remodel {

// The vertices of a design's outline, with their length scales for R = 1: the distance to the nearest
// neighbour.
struct DesignProfile {
  explicit DesignProfile(std::vector<Point> outline);
  std::vector<Point> points;
  std::vector<double> squared_scales;
};

// Both have as many points.
double squared_displacement(const DesignProfile& from, const DesignProfile& to);

}  // namespace remodel
