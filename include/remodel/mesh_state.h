#pragma once

// All of a living mesh as plain arrays: what Mesh::state() gives and Mesh::restore() takes, what the native
// file stores.

#include <cstdint>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/mesh.h"

namespace remodel {

// The record of its file in an imported mesh (remodel/import.h); empty for a generated mesh.
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

// The state of Strategy::renew (remodel/remodel.h) that a mesh carries from step to step.
struct RenewalState {
  double count_factor = 0.0;           // K: triangles of a fresh mesh over its size S; 0: not measured yet
  std::uint32_t full_adjustments = 0;  // in a row
  std::uint32_t sampled_at = 0;        // the step at which K was last looked after
  std::uint32_t samplings = 0;         // of K: the next one waits the longer
  std::uint32_t until_renewal = 0;     // replacements before the next one that renews length scales
  std::uint32_t until_shed = 0;  // replacements in which a large surplus may still go: the discretisation
                                 // has changed
  // The places where that renewal begins: slots of the vertices of triangles that replacements by `renew`
  // have made since the last one, some of them more than once; and the loops that moved since, ascending.
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
  double keep = 1.0;          // Mesh::keep()
  std::uint32_t stopped = 0;  // a Stopped: why refinement of the whole mesh ended
  RenewalState renewal;
  ImportRecord imported;
  // The places and length scales of the reference of a mesh that is held (Strategy::reference), slot by slot.
  // Empty, and not in the file, for all others.
  std::vector<double> reference_coordinates{};    // 2 per vertex slot
  std::vector<double> reference_length_scales{};  // 1 per vertex slot
  Domain reference_domain{};
  double delaunay_slack_deg = 0.0;

  friend bool operator==(const MeshState&, const MeshState&) = default;
};

}  // namespace remodel
