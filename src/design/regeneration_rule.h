#pragma once

// MeshStrategy::regenerate: two ideas of the paper's section 5 ("Improvements"), for which it has no figures.
//
//  (1) A criterion chooses between generation and remodelling for each design: "the variation in the shape
//      coefficient vector", here what that does to a mesh, the displacement from the last design
//      (design_profile.h). Far beyond a length scale nearly all triangles around the airfoil would be
//      replaced anyway, and those that follow would inherit their length scales.
//  (2) After ten full adjustments in a row the next mesh is generated, once: from then on, mostly, nothing is
//      inserted or removed any more, and the mesh stays as good as it is. The next such row begins with a
//      step that was no full adjustment.

#include <cstdint>

namespace remodel {

class RegenerationRule {
 public:
  // The number of full adjustments in a row, up to one more than lead to a generation: that it has been done.
  using Row = std::uint64_t;

  static bool generate(double squared_displacement, Row row) {
    return squared_displacement > farthest * farthest || row == long_row;
  }
  static Row after(Row row, bool full_adjustment, bool generated) {
    if (generated) return row >= long_row ? long_row + 1 : 0;
    if (!full_adjustment) return 0;
    return row > long_row ? row : row + 1;
  }

 private:
  static constexpr double farthest = 8.0;  // length scales
  static constexpr Row long_row = 10;
};

}  // namespace remodel
