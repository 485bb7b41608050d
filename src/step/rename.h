#pragma once

// The same boundary by other names: the loops of a mesh in the order of another domain, with its names, roles
// and regions. Nothing moves.

#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/mesh_data.h"
#include "step/correspondence.h"

namespace remodel {

// Whether that is all, besides places, that is between a mesh's domain and one that corresponds to it.
bool only_renames(const Domain& own, const Correspondence& to);
// Whether not even that is.
bool same_names(const Domain& own, const Correspondence& to);

class Renaming {
 public:
  // Precondition: only_renames(), and no journal. Throws nothing once the mesh is touched.
  Renaming(MeshData& mesh, const Correspondence& to);
  // To the last bit.
  void undo(MeshData& mesh) noexcept;

 private:
  void exchange(MeshData& mesh) noexcept;

  Domain domain_;  // of the mesh before: exchanged with its own
  std::shared_ptr<const MeshReference> reference_;
  std::vector<std::uint32_t> loop_heads_, pending_loops_;
  std::vector<Sides> sides_;
  std::vector<std::uint32_t> curves_;  // of each entry of the boundary table
};

}  // namespace remodel
