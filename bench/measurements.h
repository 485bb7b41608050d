#pragma once

// The measurements of bench/compare. Each is a list of rows: a name and figures, in the order of the columns.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace remodel::bench {

using Rows = std::vector<nlohmann::ordered_json>;

// The paper's six pairs of I and G around RAE 2822, alternating with the yardstick. The design differs each
// time, so that no branch predictor learns it. With `others`, CGAL's Mesh_2 and Gmsh once each too.
Rows generation(int rounds, bool others);
// The same for larger meshes: I and G grow together.
Rows large_generation(int rounds, bool ten_million);

// A full adjustment at I = 700, G = 14.
Rows adjustment(int rounds);
// Steps around the same airfoil in a mesh of 5,000 triangles and in two of a million: one is graded more
// gently, in the other the farfield alone is finer.
Rows step_scale(int rounds);

}  // namespace remodel::bench
