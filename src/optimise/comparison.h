#pragma once

// Fresh meshes that remodelled ones are compared with. They depend on the design, the evaluation and the
// options of meshing alone, not on how the mesh was remodelled: one serves every chain of the same designs.

#include <cstdint>

#include "optimise/design_domains.h"
#include "remodel/airfoil.h"
#include "remodel/history.h"
#include "remodel/mesh.h"

namespace remodel {

struct FreshMesh {
  Stopped stopped = Stopped::done;
  std::size_t triangles = 0;
  GradationError error;
  double seconds = 0.0;  // making the domain and generate()
};
FreshMesh fresh_mesh(const DesignDomains& domain_of, const QualityOptions& quality, const CstAirfoil& design);

// The design whose fresh mesh an evaluation is compared with, near its own. sigma: of the distribution that
// the design was sampled from.
CstAirfoil compared_design(const DesignDomains& domain_of, const CstAirfoil& design, std::uint64_t evaluation,
                           double sigma);

// Fills in the record's figures of the comparison; remodelled: of the remodelled mesh.
void add_comparison(const FreshMesh& fresh, const GradationError& remodelled, EvaluationRecord& record);

}  // namespace remodel
