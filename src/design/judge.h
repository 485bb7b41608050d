#pragma once

// An evaluation as the loop sees it: whatever an evaluator does, one row comes of it.

#include <memory>

#include "design/workers.h"

namespace remodel {

// Evaluates the job's design on its mesh, the last one of `living`, and fills in job.evaluation and the
// record's part of it. An evaluation that throws, or returns what is none, fails: its objective is infinite,
// the record's detail says why, and the state is gone. Stopped::interrupted where it threw after it had been
// told that the run is cancelled.
Stopped judge(const Evaluating& evaluating, const LivingMesh& living, std::unique_ptr<EvaluatorState>& state,
              Job& job);
// The job's design has failed, for this reason.
void fail(Job& job, const std::string& reason);

}  // namespace remodel
