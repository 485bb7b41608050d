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

// A vertex by its id and how often the id had been given out when the vertex was made: never given out again.
struct VertexKey {
  VertexId id;
  std::uint32_t generation = 0;
  friend auto operator<=>(const VertexKey&, const VertexKey&) = default;
  // Id and generation as one number, as they stand in files.
  std::uint64_t value() const { return std::uint64_t{generation} << 32 | id.index; }
  static VertexKey of(std::uint64_t value) {
    return {{static_cast<std::uint32_t>(value)}, static_cast<std::uint32_t>(value >> 32)};
  }
};

}  // namespace remodel
