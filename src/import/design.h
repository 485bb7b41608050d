#pragma once

// The domain of a mesh without the points that refinement put on its boundary.

#include <vector>

#include "import/loops.h"

namespace remodel {

// The curves of a mesh's domain, with the design's own points as stations. All sides between two stations
// have equally many pieces, and stations are uniform: another design with as many corresponds to it one to
// one.
struct DesignOfMesh {
  Domain domain;
  std::vector<std::vector<double>> parameters;  // of every loop: t of its points on their curves
};

// Loops that fewer than three stations would stay of keep all, and so do curves whose points crowd.
DesignOfMesh design_of(const SoundMesh& mesh, const LoopsOfMesh& loops);

}  // namespace remodel
