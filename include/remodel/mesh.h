#pragma once

// The living mesh: a constrained Delaunay triangulation of a domain and its holes, with everything that is
// needed to go on remodelling it. Made by generate(), changed by remodel().

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "remodel/changes.h"
#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel {

// The quality that a mesh promises. The same options hold for its whole life.
struct QualityOptions {
  double min_angle_deg = 30.0;                 // B = 1 / (2 sin); 0 to 34
  double max_gradation = 0.70710678118654752;  // H: r / mean length scale of a triangle's vertices; > 0
  double gradation = 4.0;   // G: length scale grows by distance / G away from the boundary; > 0
  double resolution = 1.0;  // R: boundary length scale is the distance to the nearest neighbour / R; > 0
  std::uint32_t max_vertices = 10'000'000;  // vertex budget
  // No boundary edge is split that is shorter than this, and no triangle whose circumradius is, chords. 0:
  // 1e-12 of the domain's size or of its largest coordinate, whichever is more. At least 64 times the spacing
  // of doubles at that coordinate.
  double min_edge = 0.0;
  // The smallest angle that refinement works to, where it is more than min_angle_deg; 0 to 34 degrees. For
  // meshes that were imported: min_angle_deg is what the worst triangle of the file allows.
  double refine_angle_deg = 0.0;
  friend bool operator==(const QualityOptions&, const QualityOptions&) = default;
};

// Why refinement ended. Anything but done leaves a valid constrained Delaunay mesh of lower quality.
enum class Stopped { done, vertex_budget, minimum_edge, interrupted };
const char* name_of(Stopped stopped);  // "done", "vertex-budget", "minimum-edge", "interrupted"

// Asked while a mesh is generated or remodelled, by the thread that does it: between stages, and every
// thousand steps of refinement.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  // True ends it in order: Stopped::interrupted.
  virtual bool cancelled() { return false; }
};

// Figures of the current mesh, domain triangles only.
struct MeshStatistics {
  std::size_t triangles = 0;
  std::size_t vertices = 0;  // that a domain triangle uses
  std::size_t steiner_boundary_vertices = 0;
  double min_angle_deg = 0.0;       // of all triangles
  double min_held_angle_deg = 0.0;  // but for exempt ones
  // Beyond a bound because of a small input angle: the shortest edge joins the sides of one, at equal
  // distances.
  std::size_t exempt_triangles = 0;
  double max_radius_edge = 0.0;  // max r / e_min
  double max_gradation = 0.0;    // max r / (keep H mean LS) but for exempt triangles: at most 1
};

// How the size of triangles follows the design, whatever length scales a mesh has gathered: over the domain's
// triangles, e = ln(r / (H mean LS*)), where LS*(x) is the least LS_b + |x - b| / G of the design's own
// (non-Steiner) boundary vertices b. A bias or a deviation above a fresh mesh's is what a chain of steps has
// left behind.
struct GradationError {
  double bias = 0.0;       // mean of e
  double deviation = 0.0;  // standard deviation of e
};

struct MeshState;  // remodel/mesh_state.h: all of a mesh as plain arrays
class MeshData;    // src/mesh/mesh_data.h: the library's own view

class Mesh {
 public:
  Mesh();  // an empty one, as is one that was moved from
  ~Mesh();
  Mesh(Mesh&&) noexcept;
  Mesh& operator=(Mesh&&) noexcept;
  Mesh(const Mesh&);  // a deep copy, for parallel evaluation
  Mesh& operator=(const Mesh&);

  bool empty() const;  // no domain: there is nothing to remodel
  // The domain is in the order of the last one that the mesh was remodelled to; see remodel() for loops that
  // did not move.
  const Domain& domain() const;
  const QualityOptions& options() const;
  // Triangles that steps leave as they are may take this factor of H, new ones H itself: 1, or more once
  // length scales have been renewed (Strategy::renew).
  double keep() const;
  // The gradation that every triangle of this mesh keeps, keep H: r / mean LS is at most this.
  double promised_gradation() const;
  // Strategy::reference: whether the mesh is the morph of a reference mesh that it remembers, whose
  // connectivity it has. Steps of other strategies start from that reference.
  bool held() const;
  // The angles opposite an inner edge of a held mesh may exceed 180 degrees by this. 0: it is Delaunay.
  double delaunay_slack_deg() const;
  std::uint32_t step() const;
  std::size_t triangle_count() const;  // of the domain; O(1)

  // The mesh as arrays. Of an imported one: the file's own triangles stand where both they and all that the
  // living mesh has in their place are untouched.
  FrozenMesh freeze() const;
  // True if triangles of birth 0 are a file's (remodel/import.h), not generate()'s.
  bool imported() const;
  // True if freeze() may show triangles that are not the living mesh's, which need not be Delaunay.
  bool shows_file_triangles() const;
  MeshStatistics statistics() const;
  GradationError gradation_error(StepObserver* observer = nullptr) const;  // not a number where cancelled
  // e of each triangle of a frozen view of this mesh, for FrozenMesh::gradation_error.
  std::vector<double> gradation_errors(const FrozenMesh& frozen) const;
  MeshState state() const;
  // Throws Error (format) where the state is not that of a mesh: sizes, ranges, links that do not return.
  static Mesh restore(const MeshState& state, const std::string& source);

  // The present moment, for changes_since(): from now on steps note what they change, until the mark is gone.
  Mark mark();
  // The changes since the mark, over any number of steps: O(changes). A step that was taken back changed
  // nothing. Throws Error (argument) where the mark is not of this mesh, or of a trial that was taken back.
  Changes changes_since(const Mark& mark) const;

  // The quick validation, O(triangles): links return, triangles counter-clockwise, constrained edges on the
  // design's boundary, locally Delaunay (but for delaunay_slack_deg()), angle and gradation within the
  // options. Empty if valid, otherwise the first broken rule with the ids concerned. (check() of check.h is
  // the independent, slow one.)
  std::string quick_check() const;

  MeshData& data();
  const MeshData& data() const;

 private:
  std::unique_ptr<MeshData> data_;
};

}  // namespace remodel
