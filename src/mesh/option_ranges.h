#pragma once

// The ranges of a mesh's options, in one place: options of the program, of Python and of a caller are judged
// by it, and so is what a file says that its mesh was made with.

#include <optional>
#include <string>

#include "remodel/mesh.h"

namespace remodel {

struct OptionProblem {
  const char* option;
  std::string problem;  // "found 0.000000, expected a number above 0 up to 1e6"
};

// The first option that is out of its range.
std::optional<OptionProblem> out_of_range(const QualityOptions& options);
// The factor of Mesh::keep(): 1 to 1e6.
std::optional<OptionProblem> keep_out_of_range(double keep);
// Degrees by which opposite angles of a held mesh may exceed 180: 0 to 60.
std::optional<OptionProblem> slack_out_of_range(double degrees);

}  // namespace remodel
