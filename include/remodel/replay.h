#pragma once

// A run's meshes once more. The designs of a run lie in its history, and the same designs, one after the
// other, make the same meshes to the last bit: nothing but the first mesh has to be kept.

#include <cstdint>
#include <filesystem>
#include <functional>

#include "remodel/design_space.h"
#include "remodel/history.h"
#include "remodel/mesh.h"

namespace remodel {

// Remodels the directory's first.vtkhdf to each design that the worker evaluated, in order, as optimise()
// did, and shows every mesh with its row; the row's own figures are not looked at, but for a check that the
// mesh has as many triangles as it had. A run that is still going on is replayed as far as its history is.
//
// Throws Error (file, format) for a directory that holds no run, and where history and mesh do not belong
// together, as after a run by another version. Error (argument) for a worker that the run does not have, and
// for runs whose meshes depend on more than one worker's designs (MeshStrategy::hub,
// MeshStrategy::regenerate) or on a mesh that is not in the directory (OptimiseOptions::start).
void replay(const std::filesystem::path& directory, std::uint64_t worker,
            const std::function<void(const EvaluationRecord& record, const Mesh& mesh)>& visit);
// The same of a run in any design space, which has to be the run's.
void replay(const std::filesystem::path& directory, const DesignSpace& space, std::uint64_t worker,
            const std::function<void(const EvaluationRecord& record, const Mesh& mesh)>& visit);

}  // namespace remodel
