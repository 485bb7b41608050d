#pragma once

// The evaluation of one design on a worker's mesh as a job of a crew, from bytes to bytes: the mesh and what
// the worker knows go there and come back. The mesh is whole in its bytes. What an evaluator keeps may be
// more than its bytes have (factors of matrices): a process that has done the worker's job before goes on
// with that itself.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design/checkpoint.h"
#include "design/workers.h"

namespace remodel {

struct PostedDesign {
  std::string run;  // a checksum of what has to be the same in all processes
  std::uint64_t worker = 0;
  std::uint64_t token = 0, before = 0;  // of this job, and of the worker's last one; 0: none
  WorkerState state;
  std::vector<Mesh> meshes;  // the worker's, then the hub where there is one
  Proposal proposal;
  StepTasks tasks;
  EvaluationRecord record;  // number, generation, design and step size alone
  double squared_displacement = 0.0;
};

// What came of it. Of a design that was not finished nothing but why.
struct EvaluatedDesign {
  Stopped stopped = Stopped::done;
  FinishedDesign finished;
  WorkerState state;
  std::vector<Mesh> meshes;  // one: the worker's
};

std::string encode(const PostedDesign& design, const std::vector<const Mesh*>& meshes);
std::string encode(const EvaluatedDesign& design, const Mesh& mesh);
// Throw Error (format).
PostedDesign decode_posted_design(const std::string& bytes);
EvaluatedDesign decode_evaluated_design(const std::string& bytes);

// Meshes, evaluators and options that are the same give the same text.
std::string identity_of(const DesignSpace& space, const Evaluator& evaluator);

}  // namespace remodel
