#pragma once

// Planar straight-line graphs: points, segments in any order that may cross, overlap and share points, and
// points in holes. Triangle's .poly files hold them (read_poly() of io.h). They become a Domain: what the
// segments enclose, holes left out, segments inside kept as internal constraints.

#include <cstdint>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/join.h"

namespace remodel {

struct PlanarGraph {
  struct Segment {
    std::uint32_t from = 0, to = 0;  // indices of points
    int marker = 0;
  };
  std::vector<Point> points;
  std::vector<Segment> segments;
  std::vector<Point> holes{};                // a point in each
  std::vector<std::size_t> segment_lines{};  // of each segment in its file, for messages; may be empty
  // A point in a part of the domain that has a name: what lies around it up to the next segments.
  struct Region {
    Point at;
    std::string name;
    double max_area = 0.0;  // what the file asks of the triangles there, which nothing follows; 0: nothing
  };
  std::vector<Region> regions{};
  std::vector<std::string> left_out{};  // sentences on what the file holds and the graph has no place for
};

// The treatment of segments that cross.
enum class Crossings { insert, refuse };

// The defects of a graph that were found and resolved.
struct PlanarFindings {
  std::size_t duplicate_points = 0;    // at the place of an earlier one
  std::size_t points_on_segments = 0;  // the segment is split there
  std::size_t crossings = 0;           // both segments are split at the crossing, rounded to double
  std::size_t overlaps = 0;            // pieces of segments that another one covers already
  std::size_t empty_segments = 0;      // from a point to itself
  std::size_t outside_segments = 0;    // pieces with the outside, or a hole, on both sides: left out
  std::size_t outside_points = 0;      // points of no segment that lie there: left out
  Joins joins;                         // points that were joined with others, and segments led through points
  std::vector<std::string> left_out;   // sentences on regions that found no place
};

// The domain of a graph. What lies on what, and what crosses, is decided exactly; what differs by rounding is
// joined before: a point that is nearer than `join` of the graph's size, or of its largest coordinate, to an
// earlier one is that one, and a segment as near to a point is led through it. Between them no mesh could go,
// see default_join. 0 leaves points apart. Crossings are rounded, and joined in the same way (with
// default_join at least); where that moves a segment over another one, that is a crossing too, and resolved.
// Boundary curves are named by their markers ("3"), "boundary" for 0; inner ones "internal" for 0. Chains run
// between the points where more or fewer than two segments end. A point of no segment inside is kept as a
// vertex. Regions give the parts of the domain that they lie in their names; of several in one part the
// first. Throws Error (geometry) where the graph encloses nothing, coordinates are out of range, or segments
// cross and that is refused (naming the two and the place); Error (argument) unless join is 0 or 1e-15 to
// 0.01.
Domain planar_domain(const PlanarGraph& graph, const std::string& source,
                     Crossings crossings = Crossings::insert, PlanarFindings* findings = nullptr,
                     double join = default_join);

}  // namespace remodel
