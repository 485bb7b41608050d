#pragma once

// Points of a graph that differ by rounding become one.

#include <vector>

#include "remodel/join.h"
#include "remodel/point.h"

namespace remodel {

// The larger of the size of the points' box and their largest coordinate: what tolerances are relative to.
double extent_of(const std::vector<Point>& points);

// The place of each point: its own, or that of the nearest of the earlier ones that kept theirs within
// joins.tolerance (0: all keep theirs). Counts those that are moved in `joins`. Points keep more than the
// tolerance from each other or lie at one place, and none is moved by more.
std::vector<Point> joined_places(const std::vector<Point>& points, Joins& joins);

}  // namespace remodel
