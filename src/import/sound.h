#pragma once

// A foreign mesh, judged and mended: what can be said of it before there is a domain.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel {

// An edge of one triangle only, the domain on its left.
struct BoundaryEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t marker = 0;
  std::uint32_t place = 0;  // among all named edges, in the order of the file
};

inline constexpr std::uint32_t no_region = 0xffffffff;

// An edge of two triangles that has a name, or lies between two regions.
struct InnerEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t marker = 0;
  std::uint32_t place = 0;                            // as of boundary edges
  std::uint32_t left = no_region, right = no_region;  // regions
};

// Counter-clockwise triangles, every edge in one of them or, in opposite directions, in two; no two points
// coincide; at every point of the boundary as many boundary edges end as begin, mostly one. Points keep their
// order.
struct SoundMesh {
  std::vector<Point> points;
  std::vector<std::uint8_t> steiner;  // per point; empty: none is
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::string> markers;
  std::vector<BoundaryEdge> boundary;  // in the order of their first points
  std::vector<InnerEdge> inner;
  std::vector<std::uint32_t> region;  // per triangle; empty: there is one alone
  std::vector<std::string> region_names;
  // The keys that the vertices go on with, ascending; empty: they get new ones. Those to come are above
  // last_generation.
  std::vector<VertexKey> keys;
  std::uint32_t last_generation = 0;
  VertexId vertex(std::uint32_t point) const { return keys.empty() ? VertexId{point + 1} : keys[point].id; }
  std::size_t turned = 0, unused = 0, unnamed = 0, duplicates = 0;
  bool is_steiner(std::uint32_t point) const { return !steiner.empty() && steiner[point] != 0; }
};

// Throws Error (geometry) as import_mesh() does.
SoundMesh make_sound(const FrozenMesh& mesh, const std::string& source, const std::string& unnamed);

// A directed edge and the triangle on its left.
struct DirectedEdge {
  std::uint32_t from = 0, to = 0, triangle = 0;
};
// All edges of the triangles, sorted by both ends.
std::vector<DirectedEdge> directed_edges(const std::vector<std::array<std::uint32_t, 3>>& triangles);
// The one from -> to, or null.
const DirectedEdge* find_edge(const std::vector<DirectedEdge>& edges, std::uint32_t from, std::uint32_t to);

}  // namespace remodel
