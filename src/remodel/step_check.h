#pragma once

// The quick validation of what one step changed: the triangles that it made or moved, those at the loops that
// moved, whose length scales are others, and these loops. A mesh that was valid before is valid after a step
// in which this finds nothing, but for three things that only Mesh::quick_check() sees: the count of
// triangles, a triangle that changed without the journal's knowledge, and vertices that take themselves for
// boundary vertices of no loop.

#include <string>

#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

struct StepCheck {
  std::string broken;          // empty, or the broken rule with the ids concerned
  double min_angle_deg = 0.0;  // smallest of the domain triangles checked; infinite if there are none
  bool whole = false;          // all of the mesh was checked
};

// Directly after remodel() returned `step` for this mesh. O(what changed and the loops that moved); the whole
// mesh, where the step generated it afresh, changed nothing, or was ended by a limit.
StepCheck check_step(const Mesh& mesh, const RemodelResult& step);
// The same of the whole mesh.
StepCheck check_whole(const Mesh& mesh);

}  // namespace remodel
