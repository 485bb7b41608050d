#pragma once

// The compact, frozen view of a mesh: all that files, solvers, pictures and the checker ever see.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "remodel/point.h"

namespace remodel {

struct FrozenBoundary {
  std::string name;
  // Pairs of point indices, the domain on the left of first -> second; in the order of the loop, forwards or
  // backwards (around a hole, the curves' parameters mostly run against the edges).
  std::vector<std::array<std::uint32_t, 2>> edges;
};

// The fate of a cell since an earlier state of its mesh.
enum class Fate : std::uint8_t {
  kept,   // it was there, and nothing of it has changed since
  moved,  // the same vertices were joined, of which some have moved along with the design
  made,   // it is new
};

struct FrozenMesh {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of the domain, counter-clockwise, 0-based
  std::vector<FrozenBoundary> boundaries;               // one a name

  // Empty, or one value a point or triangle: a mesh of another program has none of these.
  std::vector<double> length_scale;         // per point, chords
  std::vector<std::uint32_t> vertex_ids;    // per point: VertexId in the living mesh
  std::vector<std::uint32_t> triangle_ids;  // per triangle: TriangleId
  std::vector<std::uint32_t> birth;         // per triangle: the remodelling step that made it, 0 = generation
  std::vector<std::int32_t> curve;          // per point: index of its curve in the design, -1 in the interior
  std::vector<double> parameter;            // per point: t on that curve, 0 in the interior
  // Each point has its VertexKey::value(), which is never given out again in the life of a mesh, over
  // regenerations and files too. Points ascend by vertex id.
  std::vector<std::uint64_t> vertex_keys{};
  // The highest generation of a key so far, of a vertex that is there or is not: import_mesh() goes on above
  // it.
  std::uint32_t last_generation = 0;
  // Pairs of names of boundaries, of which the second is the first one moved (Domain::periodic). Native files
  // have them.
  std::vector<std::array<std::string, 2>> periodic{};
  // Each point has 1 on a boundary where refinement put it, 0 if it is the design's (or an imported file's).
  // Every format keeps it, so that an imported mesh has the design's own points.
  std::vector<std::uint8_t> steiner{};
  // Parts of the domain with names of their own (materials, fluids): per cell an index into region_names.
  // Empty where there is but one. Edges between two of them that no boundary names are interfaces all the
  // same.
  std::vector<std::uint32_t> region{};
  std::vector<std::string> region_names{};
  // Each triangle has ln(r / (H mean LS*)), only where it was asked for (Mesh::gradation_errors()).
  std::vector<double> gradation_error{};
  // Each cell has its fate since an earlier state, only where it was asked for (fates()).
  std::vector<Fate> fate{};
  // The angles opposite an inner edge may exceed 180 degrees by this: Mesh::delaunay_slack_deg(), 0 for
  // meshes that are not held. It is what CheckOptions::delaunay_slack_deg has to be for the mesh to be valid.
  double delaunay_slack_deg = 0.0;
  // Quadrilaterals of the domain, counter-clockwise and strictly convex: the cells of layers on walls, and
  // whatever another program's file has. The cells of a mesh are its triangles, then its quadrilaterals, in
  // that order: what is said of cells (region, fate, fields) has one value for each triangle and then one for
  // each quadrilateral. Ids, births and gradation errors are of triangles alone.
  std::vector<std::array<std::uint32_t, 4>> quads{};
  // The first so many triangles are cells of a layer, like all quadrilaterals: those that its last cells are
  // split into where the outer mesh has a vertex on their edge. They are flat on purpose: no bound on angles
  // or gradation holds for them, and their edges are no Delaunay edges. No file has this number.
  std::uint32_t layer_triangles = 0;

  std::size_t cell_count() const { return triangles.size() + quads.size(); }
  // The three or four corners of a cell.
  std::span<const std::uint32_t> cell(std::size_t i) const {
    if (i < triangles.size()) return triangles[i];
    return quads[i - triangles.size()];
  }
};

// The mesh with each quadrilateral a b c d as two triangles, in the order of the quadrilaterals and behind
// the triangles that it has: a b c and a c d, or b c d and b d a where one of those would not be
// counter-clockwise. What is said of a cell is said of both. Ids, births and gradation errors of triangles
// are left out, unless there is no quadrilateral: nothing changes then. Indices must be in range.
FrozenMesh with_split_quads(const FrozenMesh& mesh);

// The fate of each cell of `after`, since `before`: two states of one living mesh, in the order of time.
// Exact between consecutive steps. Over many of them a vertex's id may have been given out again: it counts
// as the same vertex in the interior if it has the same key (without keys, if it stands at the same point),
// on a boundary if it has the same curve and parameter. Quadrilaterals, and the triangles of layers, have no
// ids that would tell: they are kept where their vertices are the same and rest. So are all cells of meshes
// with layers, whose vertices are known by their keys. O(cells). Throws Error (argument) for a mesh without
// ids or births that has no keys either.
std::vector<Fate> fates(const FrozenMesh& before, const FrozenMesh& after);

// These numbers say what two meshes have in common, however either was made. RemodelResult has the same
// figures of one step.
struct InCommon {
  std::size_t preserved = 0;              // cells whose vertices stand where they stood
  std::size_t connected = 0;              // cells whose vertices are the same, moved or not
  std::size_t moved = 0;                  // vertices that are the same at another place
  std::size_t inserted = 0, removed = 0;  // vertices of `after` alone and of `before` alone
};

// Vertices are the same if they have the same key, and lie both in the interior or on the same curve at the
// same parameter. Two meshes that were made from `origin` may have given one key to two vertices since: a key
// that `origin` does not have counts where its vertices stand at the same place. Meshes without keys, and
// those that have no origin in common with `after` (nothing in their interior stands where a vertex of the
// same key stands in `origin`), are compared by places alone.
InCommon in_common(const FrozenMesh& before, const FrozenMesh& after, const FrozenMesh& origin);

}  // namespace remodel
