#pragma once

// The elements of a design problem (docs/design.md).

#include <optional>
#include <string>
#include <vector>

#include "aero/problem_keys.h"
#include "remodel/design_problem.h"

namespace remodel {

// The array `elements` of the problem; `warnings` gets what files of sections lost. Throws Error (format)
// naming the file and the key. degree: that of the problem, if it has one.
std::vector<DesignElement> read_elements(const Keys& problem, const std::string& file,
                                         const std::optional<int>& degree,
                                         std::vector<std::string>& warnings);

}  // namespace remodel
