#pragma once

// SU2's restart files: a table with a row for each point of the mesh, in the mesh's order, which is how SU2
// finds them. https://su2code.github.io/docs_v7/Solution-Files/ and SU2's own writers:
//   ASCII (.csv): "PointID","x","y","Density",... and a line a point, its number first.
//   Binary (.dat): five 32-bit integers, 535532, columns, points, 0 and 0; names of 33 characters, the rest
//   of each 0; then the rows as doubles. All little-endian. What follows (metadata of older versions) is not
//   read.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel {

struct Su2Restart {
  std::vector<std::string> names;  // of columns; coordinates are the columns x and y
  std::vector<double> values;      // row by row
  std::size_t points() const { return names.empty() ? 0 : values.size() / names.size(); }
  // The column of that name; names.size() if there is none.
  std::size_t column(const std::string& name) const;
};

// ASCII or binary by content. Throws Error (file, format) naming file and place: for a table that ends early,
// numbers of points other than their row's, or values that are not finite.
Su2Restart read_su2_restart(const std::filesystem::path& file);
// This reads from memory; `source` is for messages.
Su2Restart parse_su2_restart(std::string_view bytes, const std::string& source);
// The bytes are those of a binary file.
std::string su2_restart_bytes(const Su2Restart& restart);
// .csv in ASCII, numbers with 17 digits; .dat in binary. Throws Error (argument) for another extension, and
// for names that such a file cannot hold.
void write_su2_restart(const Su2Restart& restart, const std::filesystem::path& file);

// Throws Error (argument) naming `source` and the first row that is not of a mesh's point: where the columns
// x and y, as far as they are there, differ from its coordinates by more than what files of 6 digits leave
// (1e-5 of the value and 1e-7 of the mesh's extent), or where the mesh has another number of points.
void require_coordinates(const Su2Restart& restart, const FrozenMesh& mesh, const std::string& source);
// Sets the columns x and y, where they are there, to the points of a mesh. Throws Error (argument) naming
// `source` where it has another number of points.
void set_coordinates(Su2Restart& restart, const FrozenMesh& mesh, const std::string& source);

}  // namespace remodel
