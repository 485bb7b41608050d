#pragma once

// How many triangles two states of a mesh have in common, where no journal leads from one to the other.
//
// A triangle is *common* to both where the three vertices that it joins are the same in both: same ids, given
// out as often (the same vertex, not another one in its slot), at the same coordinates to the last bit.

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh_data.h"
#include "remodel/point.h"

namespace remodel {

// The domain triangles of a mesh at one moment. O(triangles) to take, and to compare.
class TriangleSnapshot {
 public:
  TriangleSnapshot() = default;  // of no triangles
  explicit TriangleSnapshot(const MeshData& mesh);

  std::size_t size() const { return others_.size(); }
  // How many of its triangles the mesh, as it is now, has too; and how many it has of which vertices may have
  // moved.
  struct Common {
    std::size_t same = 0, joined = 0;
  };
  Common common_with(const MeshData& mesh) const;

 private:
  struct Place {
    Point point;
    std::uint32_t generation = 0;
  };
  std::vector<Place> vertices_;                       // by id
  std::vector<std::uint32_t> first_;                  // of the triangles whose least id is a vertex; one more
  std::vector<std::array<std::uint32_t, 2>> others_;  // the two ids that follow the least one around them
};

}  // namespace remodel
