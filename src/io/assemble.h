#pragma once

// Brings a mesh as another program wrote it into our conventions.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"

namespace remodel::io {

// Turns clockwise cells, turns boundary edges so that the domain is on their left, and orders the edges
// of each boundary along its loops or chains, each starting at the edge that came first. Changes nothing in a
// mesh of ours. An edge without a cell, or between two, keeps its direction: judging the mesh is for
// check(). Indices must be in range. Throws Error (format) if there is no cell.
void adopt_conventions(FrozenMesh& mesh, const std::string& file);

// The mesh without named edges that have a cell on both sides, and without boundaries that have no
// others.
FrozenMesh without_inner_edges(const FrozenMesh& mesh);

// Which of the points of a file a cell has. Indices must be in range.
std::vector<bool> used_points(const FrozenMesh& mesh, std::size_t points);
// Leaves the others out of the mesh, with what is said of them and the edges of boundaries that end there, of
// which it gives the number; and out of fields on vertices.
std::size_t keep_used_points(FrozenMesh& mesh, const std::vector<bool>& used);
void keep_used_points(std::span<Field> fields, const std::vector<bool>& used);

// Gives cells their regions by name, as they are read one after the other, triangles and quadrilaterals in
// any order.
class RegionNames {
 public:
  enum class Cell { triangle, quadrilateral };
  void add(FrozenMesh& mesh, Cell cell, const std::string& name);  // of the last one that was read
  // Triangles first. One region alone says nothing.
  void finish(FrozenMesh& mesh);

 private:
  std::vector<std::uint32_t> of_quads_;
  std::map<std::string, std::uint32_t> indices_;
};

// The boundaries of a mesh that is being read, found by name: a file may have very many.
class BoundaryNames {
 public:
  // The boundary of that name, made if it is new, and whether it is.
  std::pair<std::size_t, bool> add(FrozenMesh& mesh, const std::string& name);

 private:
  std::map<std::string, std::size_t> indices_;
};

// The cell at each boundary edge, in the order of the boundaries' edges; the first one where there is none.
std::vector<std::size_t> cells_at_boundaries(const FrozenMesh& mesh);

}  // namespace remodel::io
