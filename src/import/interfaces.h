#pragma once

// The curves inside a sound mesh: interfaces between regions, and edges that the file names.

#include <cstdint>
#include <vector>

#include "import/sound.h"

namespace remodel {

// Inner edges that follow each other, of one name and between the same two regions.
struct InnerChain {
  std::vector<std::uint32_t> points;  // of a closed one the first again at the end
  std::uint32_t marker = 0;
  std::uint32_t left = no_region, right = no_region;  // of its direction
  bool closed() const { return points.front() == points.back(); }
};

// They end where others do and at the boundary; in the order of their first named edges.
std::vector<InnerChain> inner_chains(const SoundMesh& mesh);

}  // namespace remodel
