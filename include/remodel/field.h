#pragma once

// Named values on a frozen mesh: what a solver computed, for files and pictures.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel {

// triangles: the cells, the triangles and then the quadrilaterals that a mesh may have.
enum class FieldPlace : std::uint8_t { vertices, triangles };

struct Field {
  std::string name;  // not empty, without control characters
  FieldPlace place = FieldPlace::vertices;
  int components = 1;  // 1 to 3
  // The components of the first vertex or cell, then those of the second, in the order of the frozen
  // mesh. A file may hold infinities and NaN; to be written, values have to be finite.
  std::vector<double> values;
};

// Throws Error (argument) naming the field unless its name, its number of components and its number of values
// fit the mesh and all values are finite.
void require_fit(const Field& field, const FrozenMesh& mesh);
// Throws likewise unless each of them fits, and no two of one place have one name.
void require_fit(std::span<const Field> fields, const FrozenMesh& mesh);

// True if no value is infinite or NaN.
bool is_finite(const Field& field);

// The field of that name, one on vertices before one on triangles; null if there is none.
const Field* find_field(std::span<const Field> fields, const std::string& name);

}  // namespace remodel
