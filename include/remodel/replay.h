#pragma once

// A run's meshes once more. The designs of a run lie in its history, and the same designs, one after the
// other, make the same meshes to the last bit: nothing but the first mesh has to be kept.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "remodel/design_space.h"
#include "remodel/history.h"
#include "remodel/mesh.h"

namespace remodel {

// Sees each mesh with its row of the history.
using ReplayVisit = std::function<void(const EvaluationRecord& record, const Mesh& mesh)>;

// Remodels the directory's first.vtkhdf to each design that the worker evaluated, in order, as optimise()
// did, and shows every mesh with its row; of the row's own figures only those are looked at that say where a
// mesh was generated and how many triangles it had. A run that is still going on is replayed as far as its
// history is.
//
// Throws Error (file, format) for a directory that holds no run, and where history and mesh do not belong
// together. Error (argument) for a run by another version and for a worker that the run does not have.
void replay(const std::filesystem::path& directory, std::uint64_t worker, const ReplayVisit& visit);
// The design space of such a run.
std::unique_ptr<DesignSpace> replayed_space(const std::filesystem::path& directory);
// This replays a run in any design space, which has to be the run's. Its strategy cannot be
// MeshStrategy::hub, whose mesh follows the designer as well: Error (argument).
void replay(const std::filesystem::path& directory, const DesignSpace& space, std::uint64_t worker,
            const ReplayVisit& visit);

}  // namespace remodel
