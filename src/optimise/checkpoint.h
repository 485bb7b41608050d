#pragma once

// What a run goes on from: the state of the CMA-ES, the living mesh and where the history stands, as of one
// moment.
//
// checkpoint.json is the only thing that is replaced, at once, when a checkpoint is made. It names the mesh
// file that belongs to it, one of two that are written in turn, so that a run killed at any point leaves the
// old checkpoint with its mesh or the new one with its own. Checksums of both, and of the history as it was,
// tell damage, not forgery.

#include <cstdint>
#include <filesystem>
#include <string>

#include "remodel/mesh.h"

namespace remodel {

struct Checkpoint {
  std::string settings;  // that the run cannot be continued without: compared as text
  std::uint64_t evaluation = 0;
  std::uint64_t refused = 0;  // infeasible samples since that evaluation
  bool finished = false;      // all evaluations were done
  double seconds = 0.0;
  std::string cmaes;
  std::string history_checksum;  // of the history's run and rows as of then
};

bool has_checkpoint(const std::filesystem::path& directory);
// Both throw Error (file, format).
void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint, const Mesh& mesh);
Checkpoint read_checkpoint(const std::filesystem::path& directory);
Mesh read_checkpoint_mesh(const std::filesystem::path& directory);

}  // namespace remodel
