#pragma once

// The records of the triangulation and how they refer to each other. A triangle is one 64-byte cache line:
// its vertices, its neighbours and a certified circle, so that most conflict tests touch nothing else.

#include <cstdint>
#include <utility>

#include "remodel/ids.h"
#include "remodel/point.h"
#include "triangulation/circle.h"

namespace remodel {

// The vertex at infinity: corner of every ghost triangle, which lie outside the convex hull, one a hull edge.
inline constexpr VertexId infinite_vertex{0};

inline constexpr int next3(int i) {
  return i == 2 ? 0 : i + 1;
}
inline constexpr int previous3(int i) {
  return i == 0 ? 2 : i - 1;
}

// An edge by its two ends, the smaller id first.
inline std::pair<VertexId, VertexId> undirected(VertexId a, VertexId b) {
  return a < b ? std::pair(a, b) : std::pair(b, a);
}

// A triangle together with one of its three corners, or, which is the same pair, the edge opposite that
// corner.
struct Corner {
  TriangleId triangle;
  int index = 0;
};

// What a triangle stores about the edge opposite one of its corners: the same edge seen from the neighbour,
// and whether the edge is constrained. Packed as triangle * 8 + constrained * 4 + corner.
struct Link {
  std::uint32_t bits = no_index;

  Link() = default;
  Link(TriangleId triangle, int corner, bool constrained = false)
      : bits(triangle.index * 8 + (constrained ? 4U : 0U) + static_cast<std::uint32_t>(corner)) {}
  TriangleId triangle() const { return TriangleId{bits >> 3}; }
  int corner() const { return static_cast<int>(bits & 3U); }
  bool constrained() const { return (bits & 4U) != 0; }
  friend bool operator==(Link, Link) = default;
};

// Labels of the two sides of a boundary. Void is the inside of a hole or the outside of everything:
// triangulated too, but no part of the domain.
enum class Region : std::uint8_t { outside = 0, domain = 1, unknown = 255 };

struct alignas(64) Triangle {
  VertexId
      vertex[3];  // counter-clockwise; a ghost has infinite_vertex among them; a free slot has no vertex[0]
  Link link[3];   // link[i]: across the edge vertex[i+1] -> vertex[i+2]
  Circle circle;
  std::uint32_t birth = 0;  // the step that made this triangle: with the id it names a triangle for ever
  Region region = Region::outside;
  std::uint8_t badness = 0;   // used by refinement while it runs: 0 when no refinement is under way
  std::uint16_t journal = 0;  // the number of its last change: see Triangulation::last_number_

  bool alive() const { return static_cast<bool>(vertex[0]); }
  bool in_domain() const { return alive() && region == Region::domain; }
  bool ghost() const {
    return vertex[0] == infinite_vertex || vertex[1] == infinite_vertex || vertex[2] == infinite_vertex;
  }
  int corner_of(VertexId v) const { return vertex[0] == v ? 0 : vertex[1] == v ? 1 : 2; }
};
static_assert(sizeof(Triangle) == 64);

struct Vertex {
  Point point;
  double length_scale = 0.0;  // of the layer above; never read by the triangulation
  Link star;                  // a triangle at this vertex and the vertex's corner in it; none: free slot
  std::uint32_t boundary = no_index;  // of the layer above: index of its boundary record

  bool alive() const { return star.bits != no_index; }
};
static_assert(sizeof(Vertex) == 32);

}  // namespace remodel
