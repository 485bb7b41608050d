#pragma once

// What a design's domain is in a run: the airfoil in the farfield that the options describe, or the start
// mesh's domain with the design in the place of its airfoil.

#include <optional>
#include <string>

#include "remodel/domain.h"
#include "remodel/import.h"
#include "remodel/optimise.h"

namespace remodel {

class DesignDomains {
 public:
  explicit DesignDomains(const OptimiseOptions& options);

  Domain operator()(const CstAirfoil& design) const;
  // Where other loops may come in a design's way: whether its surfaces are apart and its domain is valid.
  bool feasible(const CstAirfoil& design) const;

 private:
  AirfoilDomainOptions options_;
  std::optional<Domain> others_;  // of a start mesh
  AirfoilPlace place_;
};

// The quality that a run's meshes promise.
const QualityOptions& quality_of(const OptimiseOptions& options);

// All that a run depends on of its start mesh, as a checksum.
std::string identity_of(const MeshStart& start);

}  // namespace remodel
