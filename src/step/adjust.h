#pragma once

// The adjustment stage of the specialised method (the paper's section 4.2): boundary vertices are moved to
// their places on the new design where the mesh stays valid, Delaunay and good.
//
// Words: the *moving* vertices are those of all loops that differ between the old and the new design; the
// *affected* triangles are those with a moving vertex.

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/mesh_data.h"

namespace remodel {

// Everything about the moving vertices that holds while connectivity does.
struct AdjustCache : MeshCache {
  struct Moving {
    std::uint32_t boundary;  // index of the boundary table
    VertexId vertex;
    std::uint32_t curve;
    CstStation station;                // of a CST curve
    std::size_t row = 0;               // where the vertex's CST basis starts in `basis`
    std::size_t basis_size = 0;        // 0: not a CST curve
    std::uint32_t before, after;       // positions in `moving` of the non-Steiner neighbours; the same twice
                                       // at the end of a chain, its own for a single point
    std::size_t star_begin, star_end;  // its affected triangles, in `stars`
  };
  struct Affected {
    TriangleId triangle;
    VertexId vertex[3];
    Circle circle;  // at the new positions
    bool domain;
    std::uint8_t movable = 0;  // how many of its vertices are moving
    std::uint8_t moved = 0;    // how many of them have another position
    bool good = false;         // at the new positions
  };
  // An unconstrained edge of the domain with an affected triangle beside it: is `apex` outside its circle?
  struct Edge {
    std::uint32_t affected;
    std::uint32_t across;  // no_index: the other triangle is not affected
    VertexId apex;
  };
  // A boundary edge: does the apex of its triangle in the domain encroach on it?
  struct Segment {
    std::uint32_t affected;
    VertexId a, b, apex;
  };

  std::vector<std::size_t> loops;  // that move
  std::size_t non_steiner = 0;     // moving[0 .. non_steiner) are the non-Steiner vertices, in loop order
  std::vector<Moving> moving;
  std::vector<double> basis;
  std::size_t non_steiner_basis = 0;  // where the Steiner vertices' rows begin
  std::vector<Affected> affected;
  std::vector<std::uint32_t> in_domain;  // positions in `affected`
  std::vector<std::uint32_t> stars;
  std::vector<Edge> edges;
  std::vector<Segment> segments;
  // Positions in `moving` of non-Steiner vertices, by their entries in the boundary table; of others nothing.
  std::vector<std::uint32_t> positions;

  bool finite() const;  // all new points of the step are
  bool changes_place(std::size_t i) const { return !(new_points[i] == old_points[i]); }  // moving[i]
  void forget_connectivity();  // all lists of triangles; their storage stays

  // The curves and places of the loops on the new design; after a full adjustment, on the one before it.
  std::vector<Shape> shapes;
  std::vector<Placement> placements;

  // Scratch of one step.
  std::vector<Point> old_points, new_points;
  std::vector<double> old_scales, new_scales;
  std::vector<bool> accepted;
  std::size_t changed = 0;  // by a full adjustment: domain triangles with a vertex that moved
};

// Whether the cached CST basis of one airfoil serves the other: degree and class exponents are the same.
bool same_basis(const CstAirfoil& a, const CstAirfoil& b);

// Builds the cache for the given loops, or keeps the one that the mesh has; one that is stale is brought up
// to date.
AdjustCache& adjust_cache(MeshData& mesh, std::span<const std::size_t> moving_loops);

// Sets the places and length scales that all moving vertices have on `domain`, and the old ones.
void place_moving(const MeshData& mesh, AdjustCache& cache, const Domain& domain);

// Evaluates all moving vertices at their places on `domain` at once. If every affected triangle is good
// there, moves them and returns true: a full adjustment, connectivity unchanged. Otherwise the mesh is
// unchanged, and the cache says which triangles are not good. Needs no journal: outside of one nothing throws
// once the mesh is touched. Under one, an exception leaves the mesh to rollback().
//
// In holes triangles need only stay counter-clockwise, and their circles are not kept up: whoever looks at
// one there refreshes it first.
//
// Departure from the paper: the intermediate states of a vertex-by-vertex adjustment are not tested here, as
// the final state alone is kept. The test is the same for every triangle with one moving vertex.
bool adjust_all(MeshData& mesh, AdjustCache& cache, const Domain& domain);

// After adjust_all() returned false: moves one vertex after the other where that leaves a valid mesh,
// non-Steiner vertices in the order of their loops, then Steiner vertices between two that were moved.
// Journalled. Sets cache.accepted; connectivity and circles are not touched.
void adjust_some(MeshData& mesh, AdjustCache& cache);

}  // namespace remodel
