#pragma once

// Places in the triangulation before.

#include <vector>

#include "remodel/transfer.h"
#include "transfer/box_tree.h"
#include "transfer/patches.h"

namespace remodel {

struct Place {
  std::uint32_t triangle = no_index;  // number in PatchSide::triangles
  std::array<double, 3> weights{};    // of its corners; they add up to 1
  double distance = 0.0;              // to the old domain: 0 within
};

class Locator {
 public:
  explicit Locator(const Patches& patches);

  // Where p lies, the first triangle of several; beyond the domain, by the nearest one. Throws Error
  // (argument) where that is refused, or there is no triangle.
  Place locate(Point p, Outside outside) const;
  // The changed triangles whose boxes overlap a triangle's.
  const std::vector<std::uint32_t>& candidates(const Corners& corners) const;

 private:
  Place beyond(Point p, Outside outside) const;

  const Patches& patches_;
  BoxTree changed_;  // the changed triangles
  BoxTree all_;
  mutable std::vector<std::uint32_t> found_;
};

}  // namespace remodel
