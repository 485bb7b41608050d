#pragma once

// The independent validator. It shares no predicate and no data structure with the rest: exact integer
// arithmetic on the frozen view. Slow and obvious on purpose.
//
// The rules, in the order in which they are tested. A rule is left out where one that it stands on is broken.
//   index          indices are in range, cells have three or four different points, arrays have their sizes
//   finite         coordinates, length scales and parameters are numbers
//   duplicate      no two points coincide (of those that are used, where others may be)
//   orphan-vertex  every point is in a cell
//   angle          no angle of a triangle below CheckOptions::min_angle_deg, but in layers
//   gradation      r <= H times the mean length scale of the three points of a triangle, but in layers
//   orientation    triangles are counter-clockwise and have an area (exact)
//   convex         quadrilaterals are counter-clockwise and strictly convex (exact)
//   adjacency      an edge is in one cell, or in two that pass it in opposite directions
//   boundary       exactly the edges with one cell are named (inner edges may be: constraints), once, the
//                  domain on their left, and under each name in the order of their loop, either way
//   area           the cells' areas sum up to that of the named polygons (exact)
//   delaunay       no inner edge without a name, between two triangles that are in no layer, has the point
//                  across inside the triangle's circle (exact), or the angles opposite to it sum up to at
//                  most 180 degrees and CheckOptions::delaunay_slack_deg
//   manifold       the cells of a point form one fan; or several, each between two boundary edges, where
//                  loops of the boundary touch: in a mesh of a design where the design's chains are joined
//   euler          V - E + F = 2 components - boundary loops
//   overlap        boundary edges do not cross or touch, and no place is covered twice (exact)
//   region         in a mesh of a design, named curves lie between two regions
//   design         the boundary is the design's: see CheckOptions::design
//
// In a layer are all quadrilaterals, and the first FrozenMesh::layer_triangles triangles.

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

struct Violation {
  std::string rule;                // one of the names above
  std::vector<std::uint32_t> ids;  // the points or cells concerned (indices of the frozen view)
  std::string detail;              // one sentence
};

struct CheckOptions {
  double min_angle_deg = 0.0;  // 0: not tested. Compared with a relative tolerance of 1e-9 on the
                               // radius-edge ratio (rounding of the ratio itself, 1e-15, with a margin)
  double max_gradation = 0.0;  // H; 0: not tested; needs length_scale
  bool delaunay = true;        // false: report in the result only
  bool bounds = true;  // false: what is beyond the two above is counted in the result, and no violation
  double delaunay_slack_deg =
      0.0;                     // Mesh::delaunay_slack_deg(); 0 to 60. CheckResult::delaunay knows of none
  bool unused_points = false;  // true: points of no cell are counted, not refused: other programs leave
                               // the centres of circles in their files, say
  // If given, every boundary point must be the design's at its curve and parameter, to the last bit, every
  // station of the design must be there, and boundary edges must join consecutive parameters under the name
  // of their curve, the domain on the side that the loop's role says. Needs FrozenMesh::curve and
  // ::parameter.
  const Domain* design = nullptr;
  // So far from there they may be, as a part of the mesh's largest coordinate: 0 to 1e-6. What a layer leaves
  // of an opening's curve is the same place but for rounding (LayeredMesh::meshed_domain(), 1e-14).
  double design_rounding = 0.0;
  std::size_t max_violations = 100;  // more are counted as invalid, but not listed
};

struct CheckResult {
  bool valid = false;
  std::vector<Violation> violations;
  std::size_t triangles = 0;
  std::size_t quadrilaterals = 0;
  std::size_t vertices = 0;       // points of cells
  std::size_t unused_points = 0;  // points of no cell
  double min_angle_deg = 0.0;     // of all triangles but those of layers; NaN if there are none
  // The least and the largest angle at a corner of a quadrilateral; NaN if there are none.
  double least_corner_deg = std::numeric_limits<double>::quiet_NaN();
  double largest_corner_deg = std::numeric_limits<double>::quiet_NaN();
  double min_held_angle_deg = 0.0;  // of those that are not exempt; NaN if all are
  // Below min_angle_deg, but exempt: the shortest edge joins two boundary points at the same distance from a
  // corner of less than 60 degrees in the domain, on both of its sides (a small input angle).
  std::size_t exempt_triangles = 0;
  // r / (H mean LS), H = sqrt(1/2) unless given, but for exempt triangles; NaN without length scales.
  double max_gradation = std::numeric_limits<double>::quiet_NaN();
  std::size_t beyond_bounds = 0;                // triangles beyond a bound, but for exempt ones
  std::size_t touching_points = 0;              // points where boundary loops touch
  bool delaunay = false;                        // false too where orientation, convex or adjacency is broken
  std::map<std::string, std::size_t> boundary;  // edges per name
  std::map<std::string, std::size_t> regions;   // cells per region; empty where there is but one
  double area = 0.0;                            // square chords
};

CheckResult check(const FrozenMesh& mesh, const CheckOptions& options = {});

}  // namespace remodel
