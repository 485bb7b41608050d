#pragma once

#include <compare>
#include <cstdint>

namespace remodel {

// Ids are stable while what they name lives. A vertex's is not given out again within one remodelling; a
// triangle's may be: with the step of its birth it names one triangle of all meshes between steps.
inline constexpr std::uint32_t no_index = 0xffffffffU;

struct VertexId {
  std::uint32_t index = no_index;
  friend auto operator<=>(VertexId, VertexId) = default;
  explicit operator bool() const { return index != no_index; }
};

struct TriangleId {
  std::uint32_t index = no_index;
  friend auto operator<=>(TriangleId, TriangleId) = default;
  explicit operator bool() const { return index != no_index; }
};

}  // namespace remodel
