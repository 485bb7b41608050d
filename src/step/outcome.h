#pragma once

// The figures of a step, by how it ended, and the fresh mesh that some end with.

#include <optional>
#include <span>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/adjust.h"

namespace remodel {

// The design is the mesh's own already.
RemodelResult unchanged(const MeshData& mesh);
// The step was cancelled.
RemodelResult interrupted(const MeshData& mesh);
// Ends a full adjustment: the mesh's domain becomes the one that the cache holds. Throws nothing.
RemodelResult finish_adjustment(MeshData& mesh, AdjustCache& cache);
// Under a journal, after a replacement: counts what it left of the old domain triangles, and corrects the
// mesh's own count. The vertices in `moved` are the same, at other places.
RemodelResult count_replacement(MeshData& mesh, std::span<const VertexId> moved);
// A fresh mesh takes the place of `mesh`, which becomes `before`, and goes on with its steps, its marks, and
// keys of vertices that it never gave out.
RemodelResult exchange(Mesh& mesh, GenerateResult&& fresh, std::optional<Mesh>& before);
// Puts back what exchange() has taken away. The marks are as the exchange left them.
void exchange_back(Mesh& mesh, Mesh&& before);

}  // namespace remodel
