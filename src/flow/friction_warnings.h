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
  const FlowResult& flow;    // with its friction
  double part_across = 0.0;  // of the friction, across walls
};

std::vector<std::string> friction_warnings(const FrictionWarningInputs& of);

// A stretch of a wall along which gas flows back, walking from the wall's stagnation point along either side:
// at the nose gas runs either way without being separated.
struct Separation {
  std::uint32_t from = no_index;
  std::uint32_t to = no_index;  // where gas flows forward again; none: nowhere
  double length = 0.0;          // along the wall
  bool laminar = false;         // it begins ahead of the transition that was given
};
std::vector<Separation> separations(const FrictionMesh& mesh, const FlowResult& flow);

}  // namespace remodel::flow
