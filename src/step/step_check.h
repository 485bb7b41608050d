#pragma once

// The quick validation of what steps changed: the triangles that they made or moved, those at the loops that
// moved, whose length scales are others, and these loops. A mesh that was valid at a mark is valid now if
// this finds nothing, but for three things that only Mesh::quick_check() sees: the count of triangles, a
// triangle that changed without the journal's knowledge, and vertices that take themselves for boundary
// vertices of no loop.

#include <string>

#include "remodel/mesh.h"

namespace remodel {

struct StepCheck {
  std::string broken;          // empty, or the broken rule with the ids concerned
  double min_angle_deg = 0.0;  // smallest of the domain triangles checked; infinite if there are none
  bool whole = false;          // all of the mesh was checked
};

// What has changed since the mark: O(what changed and the loops that moved). The whole mesh, where nothing
// has, or where a fresh mesh has taken its place.
StepCheck check_changes(const Mesh& mesh, const Mark& since);
// The same of the whole mesh.
StepCheck check_whole(const Mesh& mesh);

}  // namespace remodel
