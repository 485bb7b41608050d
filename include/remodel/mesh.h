#pragma once

// The living mesh: a constrained Delaunay triangulation of a domain and its holes, with everything that is
// needed to go on remodelling it. Made by generate(), changed by remodel().

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel {

// What a mesh promises. The same options hold for its whole life.
struct QualityOptions {
  double min_angle_deg = 30.0;                 // B = 1 / (2 sin); 0 to 34
  double max_gradation = 0.70710678118654752;  // H: r / mean length scale of a triangle's vertices; > 0
  double gradation = 4.0;   // G: length scale grows by distance / G away from the boundary; > 0
  double resolution = 1.0;  // R: boundary length scale is the distance to the nearest neighbour / R; > 0
  std::uint32_t max_vertices = 10'000'000;  // vertex budget
  double min_edge = 0.0;  // no edge is split that is shorter than this, chords; 0: 1e-12 of the domain's size
  // What refinement works to, where that is more than min_angle_deg; 0 to 34. For meshes that were imported:
  // min_angle_deg is what the worst triangle of the file allows.
  double refine_angle_deg = 0.0;
  // How much of H triangles may take that a step leaves as they are: they are promised r / mean LS <= keep H,
  // new ones H. Above 1 for meshes whose length scales are renewed (Strategy::renew); at least 1.
  double keep = 1.0;
  friend bool operator==(const QualityOptions&, const QualityOptions&) = default;
};

// The gradation that every triangle of a mesh keeps: r / mean LS is at most this.
inline double promised_gradation(const QualityOptions& options) {
  return options.keep * options.max_gradation;
}

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

// What a mesh that was imported (remodel/import.h) remembers of its file; empty for one that was generated.
//
// The living mesh is Delaunay. Where flips made it so, the file's own triangles are kept here, face by face:
// a face is the smallest part of the plane that both triangulations cover. Triangle and vertex ids are those
// of the living mesh; flips keep the slots, so that a face has the same slots before and after.
struct ImportRecord {
  std::vector<std::string> markers;      // boundary names in the order of the file
  std::vector<std::uint32_t> slots;      // triangle slots, the faces one after the other, rising in each
  std::vector<std::uint32_t> faces;      // 1 per slot: number of its face, from 0, not falling
  std::vector<std::uint32_t> triangles;  // 3 per slot: vertex ids of the file's triangle
  bool empty() const { return markers.empty(); }
  friend bool operator==(const ImportRecord&, const ImportRecord&) = default;
};

// What Strategy::renew (remodel/remodel.h) remembers of a mesh from step to step.
struct RenewalState {
  static constexpr std::uint32_t replacements_between_renewals = 14;
  double count_factor = 0.0;    // K: triangles of a fresh mesh over their size S; 0: not measured yet
  double interior_size = -1.0;  // the part of S in triangles without a boundary vertex; negative: unknown
  std::uint32_t full_adjustments = 0;  // in a row
  std::uint32_t sampled_at = 0;        // the step at which K was last looked after
  std::uint32_t samplings = 0;         // of K: the next one waits the longer
  std::uint32_t until_renewal = 0;     // replacements before the next one that renews length scales: at most
                                       // replacements_between_renewals
  // What that renewal looks at first: slots of the vertices of triangles that replacements by `renew` have
  // made since the last one, some of them more than once; and the loops that moved since, ascending.
  std::vector<std::uint32_t> pending_vertices;
  std::vector<std::uint32_t> pending_loops;
  // K and when it was sampled, for a fresh mesh that takes the place of another.
  void take_count_factor(const RenewalState& other) {
    count_factor = other.count_factor;
    sampled_at = other.sampled_at;
    samplings = other.samplings;
  }
  friend bool operator==(const RenewalState&, const RenewalState&) = default;
};

// The state of a living mesh as plain arrays, slot by slot, free slots included: what the native file stores.
// A mesh restored from it goes on to the same bytes as one that never left memory.
struct MeshState {
  std::vector<double> coordinates;          // 2 per vertex slot
  std::vector<double> length_scales;        // 1 per vertex slot
  std::vector<std::uint32_t> vertex_stars;  // 1 per vertex slot: a link into the star; no_index: free slot
  std::vector<std::uint32_t> vertex_generations;  // 1 per vertex slot: how often the slot was given out
  std::vector<std::int32_t> vertex_curves;        // 1 per vertex slot: -1 in the interior
  std::vector<double> vertex_parameters;          // 1 per vertex slot: t on the curve
  std::vector<double>
      vertex_scale_factors;  // 1 per vertex slot: length scale over the curve's own; 0 in the interior
  std::vector<std::uint32_t> triangle_vertices;  // 3 per triangle slot; all no_index: free slot
  std::vector<std::uint32_t> triangle_links;     // 3 per triangle slot
  std::vector<std::uint32_t> triangle_regions;   // 1 per triangle slot
  std::vector<std::uint32_t> triangle_births;    // 1 per triangle slot
  std::vector<std::uint32_t> free_vertices;      // in the order in which they will be given out
  std::vector<std::uint32_t> free_triangles;
  std::uint32_t step = 0;  // remodellings since generation
  Domain domain;
  QualityOptions options;
  RenewalState renewal;
  ImportRecord imported;

  friend bool operator==(const MeshState&, const MeshState&) = default;
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

class MeshData;  // src/mesh/mesh_data.h: the library's own view

class Mesh {
 public:
  Mesh();
  ~Mesh();
  Mesh(Mesh&&) noexcept;
  Mesh& operator=(Mesh&&) noexcept;
  Mesh(const Mesh&);  // a deep copy, for parallel evaluation
  Mesh& operator=(const Mesh&);

  const Domain& domain() const;
  const QualityOptions& options() const;
  std::uint32_t step() const;
  std::size_t triangle_count() const;  // of the domain; O(1)

  // What was imported and what became of it: the file's own triangles stand where both they and all that the
  // living mesh has in their place are untouched.
  FrozenMesh freeze() const;
  // Whether triangles of birth 0 are a file's (remodel/import.h), not generate()'s.
  bool imported() const;
  // Whether freeze() may show triangles that are not the living mesh's, which need not be Delaunay.
  bool shows_file_triangles() const;
  MeshStatistics statistics() const;
  GradationError gradation_error() const;
  // e of each triangle of a frozen view of this mesh, for FrozenMesh::gradation_error.
  std::vector<double> gradation_errors(const FrozenMesh& frozen) const;
  MeshState state() const;
  // Throws Error (format) where the state is not that of a mesh: sizes, ranges, links that do not return.
  static Mesh restore(const MeshState& state, const std::string& source);

  // The quick validation, O(triangles): links return, triangles counter-clockwise, constrained edges on the
  // design's boundary, locally Delaunay, angle and gradation within the options. Empty if valid, otherwise
  // the first broken rule with the ids concerned. (check() of check.h is the independent, slow one.)
  std::string quick_check() const;

  MeshData& data() { return *data_; }
  const MeshData& data() const { return *data_; }

 private:
  std::unique_ptr<MeshData> data_;
};

}  // namespace remodel
