#pragma once

// Loops as lists of points, and which points of two such lists correspond.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "remodel/domain.h"

namespace remodel {

// A loop, its stations in order.
struct Outline {
  const Loop* loop = nullptr;
  std::vector<Point> points;
  std::vector<std::size_t> curve;  // of each station, within the loop
  std::vector<double> t;
  Point low{}, high{};               // the box of the points
  bool left = false, right = false;  // whether the domain lies there
  std::size_t size() const { return points.size(); }
  std::size_t segments() const { return loop->open ? points.size() - 1 : points.size(); }
  std::size_t after(std::size_t station) const { return (station + 1) % points.size(); }
  Point centre() const { return 0.5 * (low + high); }
  double diagonal() const;
};
Outline outline_of_loop(const Domain& domain, std::size_t loop);
bool has_airfoil(const Loop& loop);

bool has_airfoil(const Loop& loop);

// A point of a segment, at this fraction of its parameters.
Point on_segment(const Outline& outline, std::size_t segment, double fraction);

// Rounding of points that are the same: relative to the largest coordinate.
double rounding_of(const Outline& outline);

// Of each station of `to` the one of `from` that is the same within rounding, where all of them and the
// curves between are; empty where they are not. `reversed`: they follow each other backwards.
struct SameStations {
  std::vector<std::size_t> station;
  bool reversed = false;
};
SameStations same_stations(const Outline& from, const Outline& to);

// Of each station of `to` the one of `from` that it is the successor of, in the one order or the other; links
// that are known beforehand (`known`, no_station elsewhere) are kept, where most of them keep one order.
// no_station where there is none. Empty where nothing says how the two correspond.
constexpr std::size_t no_station = static_cast<std::size_t>(-1);
SameStations following_stations(const Outline& from, const Outline& to, std::vector<std::size_t> known);

}  // namespace remodel
