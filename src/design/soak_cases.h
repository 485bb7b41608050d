#pragma once

// The kinds of domain that soak() takes through thousands of steps.

#include <memory>

#include "design/portable_math.h"
#include "remodel/domain.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

// A row of designs of one kind. next() may propose what no mesh can be made of: that has to be refused.
class SoakWalk {
 public:
  virtual ~SoakWalk() = default;
  virtual Domain next() = 0;
};

template <class AnyMesh>  // Mesh or LayeredMesh
struct SoakCase {
  AnyMesh mesh;  // of a first design
  RemodelOptions remodel;
  std::unique_ptr<SoakWalk> walk;
};

// Half of the cases are an airfoil in its farfield, some of them in two regions; the others are sets of slat,
// main airfoil and flap, ducts, lakes with islands, cracks and lone points, and airfoil meshes without a
// design, as from a file of another program. One in five lies at coordinates as of a map, kilometres from the
// origin. `random` must outlive the walk.
SoakCase<Mesh> draw_case(portable::Generator& random);
// Airfoils and sets of slat, main airfoil and flap with layers on their walls, whose stations stay. First
// heights are from 3e-7 to 3e-4 chords.
SoakCase<LayeredMesh> draw_layered_case(portable::Generator& random);

}  // namespace remodel
