#pragma once

// The living mesh of the page: around one airfoil, with layers on its surface or without.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "layer/station_lists.h"
#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"
#include "remodel/generate.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

struct PageMeshOptions {
  int points = 200;  // on the airfoil; with layers about so many, at the distances that layers want
  double gradation = 4.0;
  double reynolds = 0.0;  // that the layers are made for, as laminar flow wants them; 0: there are none
};

class PageMesh {
 public:
  PageMesh() = default;
  // Throws Error as generate() and generate_layered() do.
  PageMesh(const CstAirfoil& airfoil, const PageMeshOptions& options);

  bool has_layers() const { return options_.reynolds > 0.0; }
  const PageMeshOptions& options() const { return options_; }
  const CstAirfoil& airfoil() const { return airfoil_; }
  // Of triangles: what lies beyond the layers, or everything.
  const Mesh& outer() const { return has_layers() ? layered_.outer() : plain_; }
  std::size_t cells() const { return has_layers() ? layered_.cells() : plain_.triangle_count(); }
  FrozenMesh freeze() const { return has_layers() ? layered_.freeze() : plain_.freeze(); }
  // With the stations that this mesh has. Throws Error (geometry) for airfoils that cross themselves.
  Domain domain_of(const CstAirfoil& airfoil) const;
  double least_angle_deg() const { return quality().min_angle_deg; }

  // One step by `renew`: cells are those of the whole. Where it throws, the mesh is as it was.
  RemodelResult step(const CstAirfoil& airfoil);
  // The mesh after such a step, which is taken back.
  FrozenMesh tried(const CstAirfoil& airfoil);

 private:
  QualityOptions quality() const { return {.gradation = options_.gradation, .max_vertices = 1'000'000}; }

  PageMeshOptions options_;
  CstAirfoil airfoil_;
  Stations stations_;  // with layers: those of the airfoil that it was generated around
  Mesh plain_;
  LayeredMesh layered_;
};

// Per cell the step that joined its corners: `births` are those of `before`, and `step` is that of all cells
// that are new.
std::vector<std::uint32_t> births_by_corners(const FrozenMesh& before,
                                             const std::vector<std::uint32_t>& births,
                                             const FrozenMesh& after, std::uint32_t step);

}  // namespace remodel
