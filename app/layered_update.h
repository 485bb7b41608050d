#pragma once

// `update` of a mesh with layers.

#include <string>

#include "carry.h"
#include "command.h"
#include "domain_input.h"
#include "meshing_options.h"
#include "outputs.h"
#include "remodel/layers.h"

namespace remodel::app {

struct LayeredUpdate {
  std::string mesh;
  DomainInputOptions shapes;
  FitOptions fit;
  RemodelOptions remodelling;
  MeshOutputs outputs;
  CarryOptions carry;
  LayerCells cells = LayerCells::quadrilaterals;
  int repeat = 1;
  bool json = false;
};

// The walls with another airfoil in the place of theirs, on the same stations. Throws Error (argument) naming
// the mesh where they have none of coefficients.
Domain walls_with_airfoil(const Domain& walls, const CstAirfoil& airfoil, const std::string& mesh);
// The curve of that airfoil. Throws likewise.
const Curve& airfoil_of(const Domain& walls, const std::string& mesh);

// The boxes of a mesh's file, whose points are going to be others.
std::string boxes_of_layered(const std::string& file);

Status run_layered_update(const LayeredUpdate& update);

}  // namespace remodel::app
