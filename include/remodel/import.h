#pragma once

// Meshes that other programs made, as living meshes: what is in the file stays as it is, triangle by
// triangle, until a remodelling comes near it. And the way back from a boundary in such a mesh to a design.
//
// The promises of an imported mesh differ from place to place:
//  - Its *kept* triangles are the file's (birth 0): not better than the file made them. No triangle of the
//    mesh ever gets worse than the worst of them was in the file, or than refine_angle_deg where that is
//    less: that angle is the mesh's min_angle_deg.
//  - Its *changed* triangles are the others (birth above 0). What refinement made of them keeps
//    refine_angle_deg, but for small input angles; where boundary vertices were moved in place and nothing
//    had to be refined, the mesh's min_angle_deg.
//  - It is constrained Delaunay. Where the file is not, flips make it so; FrozenMesh shows the file's own
//    triangles where nothing near was touched, if ImportOptions say so.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"

namespace remodel {

// The treatment of the file's triangles that are not Delaunay. Those that are, but in another way than ours
// (four points on a circle), are always kept.
enum class NonDelaunay {
  flip,  // the mesh that is seen and written is the flipped one
  keep,  // it is the file's, as long as nothing near is touched
};

// The treatment of a mesh with layers of flat cells on a wall, which a remodelling would dissolve: a mesh
// with quadrilaterals, or one where on eight edges of a boundary, and on more than a tenth of them, stand
// triangles flatter than 20 to 1 (edge over height).
enum class FlatLayers {
  refuse,    // Error (geometry) that says what is lost
  dissolve,  // quadrilaterals are split, and all triangles are triangles
};

struct ImportOptions {
  NonDelaunay non_delaunay = NonDelaunay::flip;
  // The smallest angle of new triangles, 1 to 33 degrees. Above 30 degrees refinement spreads, and hundreds
  // of steps wear a mesh out. Measured on a mesh of 32 degrees: 30 keeps 71 to 91 % of the triangles, 32
  // keeps 33 to 91 %.
  double refine_angle_deg = 30.0;
  double max_gradation = 0.70710678118654752;  // H of QualityOptions
  double gradation = 0.0;                      // G; 0: measured, see import_mesh()
  double resolution = 1.0;                     // R
  std::uint32_t max_vertices = 10'000'000;
  std::string unnamed = "boundary";  // name of boundary edges without one
  FlatLayers layers = FlatLayers::refuse;
};

struct ImportResult {
  Mesh mesh;
  double min_angle_deg = 0.0;           // of the file
  std::size_t turned_triangles = 0;     // clockwise in the file
  std::size_t duplicate_triangles = 0;  // listed before with the same points: left out
  std::size_t unused_points = 0;        // in no triangle: left out
  std::size_t unnamed_edges = 0;        // of the boundary
  std::size_t non_delaunay_edges = 0;   // of the file: a point lies inside a circle
  std::size_t flipped_edges = 0;        // of the file that the living mesh does not have: those, and ties
};

// A mesh as a file has it, made alive. Points and triangles keep their order, vertices the keys that a living
// mesh wrote with them (FrozenMesh::vertex_keys), and no key of the file is given to another vertex;
// boundaries keep their names in their order. The domain is made of polylines through the mesh's boundary
// points, one a run of edges with equal names. Points that FrozenMesh::steiner says refinement added are
// Steiner vertices, the others the design's own: a mesh that goes from step to step through files does not
// take its own refinement for a design. Length scales are the triangles' own: no triangle of the file is too
// large for them. G is such that nine tenths of the edges have length scales at their ends that differ by no
// more than length / G.
//
// Edges inside that have a name are internal curves, and so are those between two regions
// (FrozenMesh::region), under the name "interface" where they have none: remodelling keeps them, and no
// triangle lies on both sides. Boundary loops that touch in a point become open chains that are joined there
// (LoopRole::left), as in any domain; the other loops stay closed. Each triangle of the living mesh is in the
// region on its side of them.
//
// Clockwise triangles are turned, and those that are listed twice, with the same points, taken once, in the
// region that is named first. Throws Error (geometry) naming `source` and the triangle, point or marker
// (counted from 0) for indices out of range, coordinates out of range, triangles without area, points that
// coincide, triangles that overlap, an edge of more than two triangles, named edges that are none of the
// mesh's or have two names, triangles too flat to compute with.
ImportResult import_mesh(const FrozenMesh& mesh, const std::string& source,
                         const ImportOptions& options = {});

// The triangles of a mesh by what they are: see above.
struct MeshPart {
  std::size_t triangles = 0;
  double min_angle_deg = 0.0;  // 0 where there is no triangle
};
struct MeshParts {
  MeshPart kept, changed;
};
MeshParts parts_of(const FrozenMesh& mesh);

// An airfoil as one closed loop of a domain, whoever drew it. Trailing edge: the corner of the outline that
// turns by more than 120 degrees, of several the one of largest x; without one, two corners of more than 45
// degrees each with a base between them of at most a tenth of the outline's extent: it is blunt; without
// these, the point of largest x. Leading edge: as of coordinate files, the point
// farthest from the trailing edge (its middle) of a smooth curve through the points around the nose, on one
// of them or between two; where the outline turns by more than 75 degrees there, that corner.
struct AirfoilPlace {
  std::size_t loop = 0;
  Point leading{}, trailing{};  // the chord, in the mesh's coordinates
  // t of the stations on a design, as in CstAirfoil::at: those that have the loop's own x, if x falls and
  // rises along it as on an airfoil; 0 is the trailing edge, 0.5 the leading edge.
  std::vector<double> parameters{};
  // Parameters of the stations on a blunt trailing edge, from the lower end (0) to the upper one (1, left
  // out); empty for a sharp one.
  std::vector<double> base{};
  // The name of the side that begins at each station of `parameters`, then of `base`: mostly all the same.
  std::vector<std::string> names{};
  // How the loop itself runs: from that one of these stations on, in their order or against it. Where neither
  // their number nor the names change, polylines follow it, so that vertices correspond one to one.
  std::size_t first = 0;
  bool backwards = false;
  bool one_name() const;
};

// The body with edges of that name; it may have edges of others too (an upper and a lower side), which they
// keep. Throws Error (argument) naming `source` where there is none, or more than one.
AirfoilPlace find_airfoil(const Domain& domain, const std::string& name, const std::string& source);

// Stations of an airfoil with that many points instead of the loop's own: x = (1 + cos 2 pi t) / 2. Throws
// Error (argument) for an odd number, one below 8, and where the loop has several names.
AirfoilPlace with_points(AirfoilPlace place, int points);

// The loop as CST coefficients in chords, as of a coordinate file; a blunt trailing edge stays blunt.
CstFit fit_airfoil(const Domain& domain, const AirfoilPlace& place, int degree);

// The domain with another airfoil in the place of the old one, chord on chord. A loop that is a CstAirfoil
// stays one. Others become polylines, one a run of equal names, through points of the airfoil: its stations,
// and seven more on every side.
Domain with_airfoil(const Domain& domain, const AirfoilPlace& place, const CstAirfoil& airfoil);

}  // namespace remodel
