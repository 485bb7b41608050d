#pragma once

// The part of a mesh that differs between two of its states, before and after: both triangulations of it,
// with vertices numbered from 0 in each.

#include <cstdint>
#include <span>
#include <vector>

#include "remodel/changes.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"
#include "transfer/intersection.h"
#include "transfer/number_map.h"

namespace remodel {

// One of the two triangulations. `number` is what values are numbered by: ids, or positions.
struct PatchSide {
  struct Triangle {
    std::array<std::uint32_t, 3> corners;  // numbers of vertices here
    std::uint32_t number;
  };
  std::vector<Point> points;
  std::vector<std::uint32_t> numbers;  // of vertices
  std::vector<Triangle> triangles;

  Corners corners(const Triangle& t) const {
    return {points[t.corners[0]], points[t.corners[1]], points[t.corners[2]]};
  }
  Corners corners(std::size_t t) const { return corners(triangles[t]); }
};

struct Patches {
  PatchSide before, after;
  // So many of before's triangles have changed; those behind them have not, and share a vertex with one that
  // has.
  std::size_t changed = 0;
  // Of after's vertices: the same vertex before, or no_index; and whether it stands where it stood.
  std::vector<std::uint32_t> same_vertex;
  std::vector<bool> at_rest;
  // Of after's triangles: the one before that joins the same vertices, or no_index.
  std::vector<std::uint32_t> same_triangle;
  // Of after's vertices: a third of the area of the triangles there that have not changed.
  std::vector<double> area_at_rest;
  // Triangles that have not changed but for their numbers: (before, after).
  std::vector<std::pair<std::uint32_t, std::uint32_t>> renumbered;

  // Values there are before and after. Positions alone: of each number after, the same one before.
  std::size_t vertices_before = 0, vertices_after = 0, triangles_before = 0, triangles_after = 0;
  std::vector<std::uint32_t> same_vertices, same_triangles;
  // Ids alone: those of before that name nothing now.
  std::vector<std::uint32_t> gone_vertices, gone_triangles;
};

class Moment;  // moment.h
Patches patches_since(const Moment& moment);
Patches patches_between(const FrozenMesh& before, const FrozenMesh& after);

// Gathers the triangles of a patch, whose vertices are named by what values are numbered by.
class PatchBuilder {
 public:
  using Triple = std::array<std::uint32_t, 3>;

  // Room for so many vertices.
  PatchBuilder(Patches& patches, std::size_t expected)
      : patches_(patches), before_(expected), after_(expected) {}

  // point(number), for the vertices that are seen for the first time.
  template <class PointOf>
  PatchSide::Triangle before(const Triple& vertices, std::uint32_t number, PointOf point) {
    return {local(vertices, patches_.before, before_, point), number};
  }
  template <class PointOf>
  PatchSide::Triangle after(const Triple& vertices, std::uint32_t number, PointOf point) {
    return {local(vertices, patches_.after, after_, point), number};
  }
  // Finds what is the same and takes triangles that are wholly so out of the patch. `old_of_new(number)`: the
  // number before of a vertex that was there, or no_index.
  template <class OldOfNew>
  void match(OldOfNew old_of_new) {
    for (const std::uint32_t number : patches_.after.numbers) {
      const std::uint32_t old = old_of_new(number);
      patches_.same_vertex.push_back(old == no_index ? no_index : before_.find(old));
    }
    match_triangles();
  }

 private:
  template <class PointOf>
  static Triple local(const Triple& vertices, PatchSide& side, NumberMap& numbers, PointOf point) {
    Triple result;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto size = static_cast<std::uint32_t>(side.points.size());
      const auto [at, is_new] = numbers.emplace(vertices[k], size);
      if (is_new) side.points.push_back(point(vertices[k])), side.numbers.push_back(vertices[k]);
      result[k] = at;
    }
    return result;
  }
  void match_triangles();

  Patches& patches_;
  NumberMap before_, after_;  // vertices of each side by number
};

}  // namespace remodel
