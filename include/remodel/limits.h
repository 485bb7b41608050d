#pragma once

// This says where a limit ended refinement: what to tell people of the place.

#include <string>

#include "remodel/mesh.h"

namespace remodel {

// The text says where triangles are smallest, as a part of a sentence: "at (1, 2), where the walls "a" and
// "b" are 1e-9 apart". O(triangles). Empty for a mesh without triangles.
std::string crowded_place(const Mesh& mesh);

}  // namespace remodel
