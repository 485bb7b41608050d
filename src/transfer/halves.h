#pragma once

// The quadrilaterals of a mesh as the triangles of with_split_quads(): transfer knows triangles alone. Values
// of cells become those of triangles and come back.

#include <cstdint>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/transfer.h"

namespace remodel {

class Halves {
 public:
  Halves() = default;  // of a mesh that has no quadrilaterals
  // Throws Error (argument) naming `which` for a quadrilateral with a point that is not there.
  Halves(const FrozenMesh& mesh, const char* which);

  bool any() const { return !share_.empty(); }
  // The mesh of triangles, in the place of `mesh`, of which these are.
  FrozenMesh take() { return std::move(split_); }
  std::size_t cells() const { return triangles_ + share_.size() / 2; }
  std::uint32_t cell_of(std::uint32_t triangle) const;
  // Both halves get the value of their quadrilateral, and a quadrilateral the mean of its halves, by areas.
  std::vector<double> to_triangles(const std::vector<double>& values, int components) const;
  std::vector<double> to_cells(const std::vector<double>& values, int components) const;

 private:
  friend ValueMap map_of_cells(const ValueMap& map, const Halves& before, const Halves& after);

  FrozenMesh split_;
  std::size_t triangles_ = 0;
  std::vector<double> share_;  // of the area of its quadrilateral, per half
};

// The map of cells that a map of triangles by positions makes.
ValueMap map_of_cells(const ValueMap& map, const Halves& before, const Halves& after);

}  // namespace remodel
