#pragma once

// This says where a limit ended refinement, what to tell people of the place, and how large the mesh is.

#include <cstddef>
#include <map>
#include <string>

#include "remodel/mesh.h"

namespace remodel {

// The text says where triangles are smallest, as a part of a sentence: "at (1, 2), where the walls "a" and
// "b" are 1e-9 apart". O(triangles). Empty for a mesh without triangles.
std::string crowded_place(const Mesh& mesh);

// This has what MeshStatistics and FrozenMesh::boundaries count, in time proportional to the boundary.
struct MeshCounts {
  std::size_t triangles = 0, vertices = 0;
  std::size_t steiner_boundary_vertices = 0;
  std::map<std::string, std::size_t> boundary;  // edges, by name
};
MeshCounts counts_of(const Mesh& mesh);

}  // namespace remodel
