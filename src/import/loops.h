#pragma once

// The boundary of a sound mesh as a domain.

#include <cstdint>
#include <vector>

#include "import/sound.h"
#include "remodel/domain.h"

namespace remodel {

struct LoopsOfMesh {
  Domain domain;
  // The points of every loop, in the order of the domain's stations.
  std::vector<std::vector<std::uint32_t>> points;
  std::vector<bool> joint;  // per point: whether a chain ends there
};

// One loop a closed chain of boundary edges, the domain on the left, one polyline a run of edges with the
// same marker, one station a point. Loops come in the order of their first named edges, and begin with the
// run that has it; a loop of one name begins with that edge, or the next one before it that begins at a point
// of the design. Loops that touch themselves or others are cut there: their pieces are open chains. Then
// chains of inner edges, in the order of theirs.
LoopsOfMesh loops_of(const SoundMesh& mesh);

}  // namespace remodel
