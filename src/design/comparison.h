#pragma once

// Fresh meshes that remodelled ones are compared with. They depend on the design, the evaluation and the
// options of meshing alone, not on how the mesh was remodelled: one serves every chain of the same designs.

#include <cstdint>
#include <span>
#include <vector>

#include "remodel/design_space.h"
#include "remodel/living_mesh.h"
#include "remodel/mesh.h"

namespace remodel {

struct FreshMesh {
  Stopped stopped = Stopped::done;
  std::size_t triangles = 0;
  GradationError error;
  double seconds = 0.0;  // making the domain and generate()
};
FreshMesh fresh_mesh(const DesignSpace& space, const QualityOptions& quality, std::span<const double> design);

// The design whose fresh mesh an evaluation is compared with, near its own. step_size: of the distribution
// that the design was sampled from; 0: of none.
std::vector<double> compared_design(const DesignSpace& space, std::span<const double> design,
                                    std::uint64_t evaluation, double step_size);

// Fills in the record's figures of the comparison; remodelled: of the remodelled mesh.
void add_comparison(const FreshMesh& fresh, const GradationError& remodelled, MeshStep& record);

}  // namespace remodel
