#pragma once

// What reader and writer of Gmsh's format share.

#include <string_view>

namespace remodel::io {

inline constexpr int msh_line = 1;
inline constexpr int msh_triangle = 2;
inline constexpr int msh_quadrilateral = 3;
inline constexpr int msh_second_order[] = {8, 9, 10, 16};  // a line, a triangle, quadrilaterals
inline constexpr int msh_point = 15;
inline constexpr std::string_view vertex_keys_name = "vertex_key";  // of the nodes' data that holds them
inline constexpr std::string_view domain_name = "domain";           // physical name of the cells

}  // namespace remodel::io
