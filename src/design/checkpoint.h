#pragma once

// A checkpoint is all that a run goes on from: the states of the designer and the evaluators, the living
// meshes and where the history stands, as of one moment. Where several workers were interrupted, meshes and
// evaluators' states are those after the last finished design of each, and what came of the ones that the
// history has not come to is `ahead`.
//
// checkpoint.json is the only thing that is replaced, at once, when a checkpoint is made. It names the meshes
// and evaluators' states that belong to it, one of two sets that are written in turn, so that a run killed at
// any point leaves the old checkpoint with its files or the new one with its own. Checksums of all, and of
// the history as it was, tell damage, not forgery.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "design/workers.h"
#include "remodel/history.h"
#include "remodel/mesh.h"

namespace remodel {

// A design that was evaluated before one that comes ahead of it was: its row, which the loop has not
// completed, and its evaluation. Its worker's mesh is its own already.
struct FinishedDesign {
  EvaluationRecord record;
  Evaluation evaluation;
};

struct Checkpoint {
  std::string settings;  // that the run cannot be continued without: compared as text
  std::uint64_t evaluation = 0;
  std::uint64_t refused = 0;  // infeasible samples since that evaluation
  bool finished = false;      // all evaluations were done
  double seconds = 0.0;
  std::string designer;  // its state
  WorkersState workers;
  std::vector<FinishedDesign> ahead{};  // of later evaluations, where workers were interrupted
  std::string history_checksum;         // of the history's run and rows as of then
};

bool has_checkpoint(const std::filesystem::path& directory);
// All throw Error (file, format). The meshes are those of the workers in order, then the hub; one that is
// several workers' is written once.
void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint,
                      std::span<const Mesh* const> meshes);
Checkpoint read_checkpoint(const std::filesystem::path& directory);
std::vector<Mesh> read_checkpoint_meshes(const std::filesystem::path& directory);

// Whether a checkpoint may have a file of that name: checkpoint-a.vtkhdf, checkpoint-b-2.state.
bool is_checkpoint_file(std::string_view name);
// The one that the first checkpoint of a directory has, with one mesh.
inline constexpr std::string_view first_checkpoint_mesh = "checkpoint-a.vtkhdf";

}  // namespace remodel
