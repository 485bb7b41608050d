#pragma once

// The whole state of a triangulation as plain arrays, free slots included, and back.

#include <string>

#include "triangulation/triangulation.h"

namespace remodel {

inline constexpr double largest_coordinate = 1e60;  // of predicates.h: beyond it determinants overflow

struct TriangulationState {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> generations;
  std::vector<Triangle> triangles;  // circles need not be set: they follow from the vertices
  std::vector<std::uint32_t> free_vertices, free_triangles;  // last first

  // Under a journal: as if it were committed.
  static TriangulationState of(const Triangulation& triangulation);
  // Returns the broken rule, empty if the state is one of a triangulation (links, ranges, orientation); then
  // `result` is it.
  std::string restore(Triangulation& result) const;

 private:
  std::string check_ranges() const;
};

}  // namespace remodel
