#pragma once

// The design space of a problem file that deforms an outline or a domain (docs/design.md).

#include <filesystem>
#include <string>
#include <vector>

#include "aero/problem_keys.h"
#include "remodel/deformation.h"
#include "remodel/domain.h"

namespace remodel {

// The key `space` of the problem: an object, or the path of a file that has it. `keys` are the problem's.
// `farfield`: of an outline's domain. `warnings` gets what files of outlines lost. Throws Error (format)
// naming the file and the key, and what reading the files throws.
Deformation read_space(const Keys& keys, const Json& problem, const std::string& file,
                       const AirfoilDomainOptions& farfield, std::vector<std::string>& warnings);

}  // namespace remodel
