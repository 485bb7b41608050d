#pragma once

// These functions join what differs by rounding of its coordinates alone, and is meant to be one.

#include <cstddef>
#include <string>

#include "remodel/domain.h"

namespace remodel {

// Places that differ by rounding are joined: those nearer to each other than this share of a domain's size,
// or of its largest coordinate, whichever is more. Places that are written with fifteen digits, or computed
// by a few operations, differ by up to 1.5e-14 of their largest coordinate. Refinement makes no edge shorter
// than 1e-12 (QualityOptions::min_edge), and between walls that are nearer than ten of these no mesh could
// go: up to there nothing is lost.
inline constexpr double default_join = 1e-11;

// Joins say what was joined.
struct Joins {
  std::size_t count = 0;   // points, or ends of chains
  double largest = 0.0;    // distance
  double tolerance = 0.0;  // in the units of the coordinates
  std::string first = {};  // the two places of the first one
};

// Ends of chains that miss a station, or each other, by rounding are moved onto it: those of lines, polylines
// and splines without a placement, or else the station if it is a point of such a curve. Throws Error
// (geometry) naming both places where neither can be moved, where an end misses the inside of a side, where
// there is no station, and where different loops come as near to each other; Error (argument) unless `join`
// is 0 (nothing is done) or 1e-15 to 0.01.
void require_join(double join);  // throws that Error
Joins join_ends(Domain& domain, const std::string& source, double join = default_join);

}  // namespace remodel
