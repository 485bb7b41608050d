#pragma once

// The quick validation of what one step changed. A mesh that was valid before the step is valid after it
// where this finds nothing: a triangle that the step did not touch is as it was, and so is what lies across
// its edges, unless that was touched.

#include <string>

#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

struct StepCheck {
  std::string broken;          // empty, or the broken rule with the ids concerned
  double min_angle_deg = 0.0;  // smallest of the domain triangles checked; infinite if there are none
};

// Directly after remodel() returned `step` for this mesh. O(what changed); the whole mesh, where the step
// generated it afresh.
StepCheck check_step(const Mesh& mesh, const RemodelResult& step);
// The same of the whole mesh.
StepCheck check_whole(const Mesh& mesh);

}  // namespace remodel
