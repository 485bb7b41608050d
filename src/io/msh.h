#pragma once

// What reader and writer of Gmsh's format share.

#include <cstdint>
#include <optional>
#include <string_view>

namespace remodel::io {

inline constexpr int msh_line = 1;
inline constexpr int msh_triangle = 2;
inline constexpr int msh_quadrilateral = 3;
inline constexpr int msh_second_order[] = {8, 9, 10, 16};  // a line, a triangle, quadrilaterals
inline constexpr int msh_point = 15;
inline constexpr std::string_view vertex_keys_name = "vertex_key";  // of the nodes' data that holds them

// Data of Gmsh's are doubles, which are exact up to 2^53: for keys of vertices that is two million
// regenerations. The keys of layers' points begin at 2^63: they are the negative numbers, from -1 down.
inline constexpr std::uint64_t first_layer_key = std::uint64_t{1} << 63;
// Nothing where a double cannot have it.
constexpr std::optional<double> real_of_key(std::uint64_t key) {
  const bool of_layer = key >= first_layer_key;
  const std::uint64_t number = of_layer ? key - first_layer_key + 1 : key;
  if (number >= std::uint64_t{1} << 53) return std::nullopt;
  return of_layer ? -static_cast<double>(number) : static_cast<double>(number);
}
// 0 for what is no key.
constexpr std::uint64_t key_of_real(double real) {
  if (!(real > -0x1p53 && real < 0x1p53) || (real < 0.0 && real > -1.0)) return 0;
  return real < 0.0 ? first_layer_key + static_cast<std::uint64_t>(-real) - 1
                    : static_cast<std::uint64_t>(real);
}

inline constexpr std::string_view domain_name = "domain";  // physical name of the cells

}  // namespace remodel::io
