#pragma once

// The sections $NodeData and $ElementData of .msh files:
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/msh_numbers.h"
#include "io/scanner.h"
#include "remodel/field.h"

namespace remodel::io {

class MshFields {
 public:
  // plane: the numbers of sections whose third component was added, see plane_vectors.h.
  MshFields(Scanner& scan, MshNumbers& numbers, std::set<std::size_t> plane)
      : scan_(scan), numbers_(numbers), plane_(std::move(plane)) {}

  // Reads what stands between the section's name and its end. indices: by the tags of nodes or triangles;
  // other elements' values are passed over. A field that does not say something of all of them that are
  // `used` is left out, and of several time steps the first one is taken.
  void read(FieldPlace place, bool binary, const std::unordered_map<std::int64_t, std::uint32_t>& indices,
            const std::vector<bool>& used);

  // Those on vertices first, in alphabetical order.
  std::vector<Field> take();

 private:
  std::string read_name();

  Scanner& scan_;
  MshNumbers& numbers_;
  std::set<std::size_t> plane_;
  std::size_t sections_ = 0;  // read so far
  std::vector<Field> fields_;
  std::set<std::pair<FieldPlace, std::string>> known_;  // of fields_
};

}  // namespace remodel::io
