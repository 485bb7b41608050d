#pragma once

// What of a domain another one has too, by geometry: whatever the order of the loops, their direction and
// their first corner.
//
// Words: a *station* of a loop is one of its points; *segment* s of a loop runs from its station s to the
// next one. A *link* names the old station or segment that a new one is, or is the successor of.

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "remodel/domain.h"

namespace remodel {

constexpr std::size_t no_link = std::numeric_limits<std::size_t>::max();

struct StationLink {
  std::size_t loop = no_link, station = no_link;
  bool there() const { return loop != no_link; }
  friend bool operator==(const StationLink&, const StationLink&) = default;
};
struct SegmentLink {
  std::size_t loop = no_link, segment = no_link;
  bool reversed = false;  // it runs against the old one
  bool there() const { return loop != no_link; }
  friend bool operator==(const SegmentLink&, const SegmentLink&) = default;
};

struct LoopLinks {
  std::size_t from = no_link;  // the old loop that this one is, or is the successor of
  bool in_order = false;       // station for station and curve for curve, from the first on: one_to_one()
  std::vector<StationLink> stations;
  std::vector<SegmentLink> segments;
};

struct Correspondence {
  // The wanted domain, with loops that are old ones, to the last rounding of their points, in the old one's
  // terms: its curves, direction and first station, by the new names and regions.
  Domain domain;
  std::vector<LoopLinks> loops;  // of that
};

// How the wanted domain follows from the mesh's own. Of a loop that is none of the old ones some segments may
// be: those between two points that an old one joins, with the domain on the same sides. A loop that is left
// is paired with one that is left, by its names, its role and its place, and its stations with that one's in
// order, as far as the two correspond; loops that do not pair have appeared, or are gone. No two links name
// one old segment. n log n, but for loops that correspond in parts: n^2 of these.
Correspondence correspond(const Domain& own, const Domain& wanted);

// Whether no loop has appeared or is gone, and of each all segments correspond but for a few.
bool corresponds_in_parts(const Domain& own, const Correspondence& to);

// Whether more than a few of the stations of loops that pair are none of the old ones.
bool differs_much(const Domain& own, const Correspondence& to);

// Whether no loop of a domain that corresponds to the mesh's own by index, in order, may be another one's, or
// begin elsewhere, or run the other way round: what moves moves by less than the way to the next station, or
// its curves say where it begins. Cheap.
bool corresponds_by_index(const Domain& own, const Domain& wanted, std::span<const std::size_t> moving);

// Whether two loops are one_to_one() but for the names of their curves.
bool in_order(const Loop& a, const Loop& b);

}  // namespace remodel
