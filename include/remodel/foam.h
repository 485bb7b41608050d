#pragma once

// OpenFOAM cases: a plane mesh as one that is a cell thick, and the fields of a time directory, carried from
// one mesh to the next. https://www.openfoam.com/documentation/user-guide/4-mesh-generation-and-conversion
//
// Cell i is cell i of the frozen mesh, from z = 0 to z = 1: triangles are prisms, quadrilaterals hexahedra. A
// boundary becomes a patch of its name (name_in() of remodel/io.h), of type `wall` unless it is called
// farfield, inlet or outlet; `front` and `back` are of type `empty`. Curves inside the mesh and the names of
// regions are left out.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"

namespace remodel {

// Writes constant/polyMesh of the case that `file` names by lying in its directory (case.foam, as ParaView
// opens it), and that file, which is empty. The directory polyMesh is replaced as a whole. Throws Error
// (argument) for names of boundaries that OpenFOAM cannot have, Error (file) where it cannot be written.
void write_foam_mesh(const FrozenMesh& mesh, const std::filesystem::path& file);

// A list of values, one for each cell or face of a patch, in the text of a field's file.
struct FoamList {
  std::size_t begin = 0, end = 0;  // what is replaced, from `List` to the last parenthesis
  std::string patch;               // empty: cells
  int components = 1;
  std::vector<double> values;
};

struct FoamField {
  std::string name;  // of its file
  std::string text;
  std::vector<FoamList> lists;  // in the order of the text; uniform values are none
};

struct FoamTime {
  std::vector<FoamField> fields;      // in alphabetical order
  std::vector<std::string> left_out;  // other files: fields on faces, for example, which solvers make again
};

// The fields in cells of a time directory, in ASCII. Throws Error (file, format) naming file and place: for
// binary or compressed files, and lists of another number of values than the mesh has cells, or faces of
// that patch.
FoamTime read_foam_time(const std::filesystem::path& directory, const FrozenMesh& mesh);
// One file, for example of a checkpoint.
FoamField parse_foam_field(std::string name, std::string text, const std::string& source,
                           const FrozenMesh& mesh);
std::string foam_text(const FoamField& field);
// Makes the directory if it is missing, and replaces the files of the fields.
void write_foam_time(const FoamTime& time, const std::filesystem::path& directory);

// To another mesh: cells by `cells`, which gets values before, `components` of each, and makes those after
// of them; faces of patches have the values of the nearest face, by its middle, of the same patch before.
void carry_foam_time(FoamTime& time, const FrozenMesh& before, const FrozenMesh& after,
                     const std::function<void(int components, std::vector<double>& values)>& cells);

// The latest of the time directories above 0 in a case; empty where there is none.
std::filesystem::path latest_foam_time(const std::filesystem::path& case_directory);

}  // namespace remodel
