#pragma once

// Small input angles: which triangles may break the bounds on quality. A triangle is exempt if its shortest
// edge joins two points of the boundary that lie at the same distance from one corner of less than 60 degrees
// inside the domain, each on another of the corner's two sides (Shewchuk 2002: refinement cannot do better
// there). The top of a layer counts as boundary: triangles beyond it were refined with it given.

#include <array>
#include <vector>

#include "check/topology.h"
#include "remodel/frozen_mesh.h"

namespace remodel::checker {

class Exemption {
 public:
  // name_of_edge: per edge of the topology, its boundary or none.
  Exemption(const FrozenMesh& mesh, const Topology& topology, const std::vector<std::uint32_t>& name_of_edge);
  bool exempts(std::uint32_t triangle) const;

 private:
  using Sides = std::array<std::uint32_t, 2>;  // of a corner: the next points along them
  struct Reached {
    std::uint32_t corner, along;  // along: the side by which the corner was reached
  };
  Point direction(std::uint32_t from, std::uint32_t to) const;
  void find_corner(std::uint32_t v, const Topology& topology);
  std::vector<Reached> corners_from(std::uint32_t v) const;

  const FrozenMesh& mesh_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  // per point: along boundary edges
  std::vector<std::vector<Sides>> corners_;             // per point: its small wedges
};

}  // namespace remodel::checker
