#pragma once

// A sound mesh as the domain's part of a living triangulation.

#include "import/design.h"
#include "import/loops.h"
#include "import/sound.h"
#include "mesh/mesh_data.h"

namespace remodel {

// Fills `data`, whose domain and options are set, with the mesh as it is: point i is vertex i + 1, triangle i
// has slot i. What lies outside the domain is the constrained Delaunay triangulation of the boundary. Not
// Delaunay yet inside. Throws RecoveryError where the boundary is none that can be meshed.
void graft(const SoundMesh& mesh, const LoopsOfMesh& loops, MeshData& data);

// Gives the mesh another domain of the same curves: boundary vertices that are no stations of it become
// Steiner vertices. Length scales are to be set afterwards.
void take_design(DesignOfMesh design, MeshData& data);

// Flips until the mesh is Delaunay, and records the file's triangles for what is to be shown of them.
struct Flips {
  std::size_t non_delaunay = 0;  // edges of the file
  std::size_t flipped = 0;       // edges of the file that are no more
};
enum class Record { ties, all };
Flips make_delaunay(const SoundMesh& mesh, Record record, MeshData& data);

}  // namespace remodel
