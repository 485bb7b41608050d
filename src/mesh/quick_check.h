#pragma once

// The quick validation of a living mesh: everything that a step can break, with the library's own exact
// predicates (the slow, independent validator is src/check). Mesh::quick_check() asks it for all triangles
// and loops, check_step() for those that a step changed.

#include <string>

#include "geometry/opposite_angles.h"
#include "mesh/mesh_data.h"
#include "mesh/small_angles.h"

namespace remodel {

// Answers are empty, or the broken rule with the ids concerned.
class QuickCheck {
 public:
  explicit QuickCheck(const MeshData& mesh);

  // A triangle that is there: its links return, it is counter-clockwise, locally Delaunay, and as good as
  // promised.
  std::string triangle(TriangleId t) const;
  // The entries of a loop name each other, its vertices and edges are the design's, and constrained between
  // the right regions.
  std::string loop(std::size_t loop) const;

 private:
  const MeshData& mesh_;
  QualityBounds promised_;
  SmallAngles small_angles_;
  OppositeAngles opposite_;
};

}  // namespace remodel
