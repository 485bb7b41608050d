#pragma once

// What a person has to know of a flow with friction before using its coefficients: sentences on cells at
// walls, layers, and what a given transition leads to.

#include <string>
#include <vector>

#include "flow/scheme/friction_mesh.h"
#include "remodel/flow.h"

namespace remodel::flow {

struct FrictionWarningInputs {
  const FrictionMesh& mesh;
  const FlowResult& flow;                // with its friction
  double part_across = 0.0;              // of the friction, across walls
  const std::vector<double>& vorticity;  // at vertices
};

std::vector<std::string> friction_warnings(const FrictionWarningInputs& of);

// Where gas begins to flow back along a wall ahead of the transition that was given, walking from a wall's
// stagnation point along either side, and where along that side it flows forward again; at the nose gas runs
// either way without being separated.
struct LaminarSeparation {
  std::uint32_t vertex = no_index;
  std::uint32_t reattached = no_index;  // none: nowhere
};
std::vector<LaminarSeparation> laminar_separations(const FrictionMesh& mesh, const FlowResult& flow);

}  // namespace remodel::flow
