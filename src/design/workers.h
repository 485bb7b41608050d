#pragma once

// The meshes of a run: each worker has a living mesh of its own, with what the evaluator keeps of it, and
// evaluates the designs that it is handed one after the other. Threads take workers, so that a worker's mesh
// never depends on their number.
//
// The assignment of designs to workers. Those of a generation are handed out in the order in which they were
// sampled. Each goes to the worker whose last design is nearest, that is with the smallest displacement to it
// (design_profile.h), of several the first; but no worker takes more than its share of a generation, the
// population over the number of workers, rounded up. Nothing looks ahead: where a generation is evaluated in
// parts, with a checkpoint in between, the same workers evaluate the same designs.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/threads.h"
#include "design/design_profile.h"
#include "design/hub.h"
#include "design/living_mesh.h"
#include "design/regeneration_rule.h"
#include "remodel/crew.h"
#include "remodel/designer.h"
#include "remodel/evaluator.h"
#include "remodel/optimise.h"

namespace remodel {

// A design to be evaluated, and what came out.
struct Job {
  Proposal proposal;
  StepTasks tasks{};
  EvaluationRecord record{};  // the mesh's part, the evaluation's and the worker are filled in
  Evaluation evaluation{};
  // Anything but done: the mesh could not be finished, or the evaluation was cancelled; and the designs that
  // its worker was to evaluate after this one were not.
  Stopped stopped = Stopped::done;
  // Record and evaluation are complete. Where that is so beforehand, the design was evaluated before an
  // interrupt, and the worker's mesh has been its own since.
  bool finished = false;
  double squared_displacement = 0.0;  // from its worker's last design, where that matters
};

// The state of a worker beside its mesh, for checkpoints.
struct WorkerState {
  std::vector<double> design;   // its last one
  std::uint64_t evaluated = 0;  // of this generation
  std::uint64_t full_adjustments = 0;
  RegenerationRule::Row row = 0;
  bool checked = false;     // its mesh, as a whole, since the start
  std::string evaluator{};  // EvaluatorState::bytes() of its state
  // Of its mesh, where that is not its last one, which failed at a limit or was interrupted; empty: it is.
  std::vector<double> mesh_design{};
  const std::vector<double>& design_of_mesh() const { return mesh_design.empty() ? design : mesh_design; }
};

struct WorkersState {
  std::vector<WorkerState> workers;
  std::uint64_t last = 0;  // the one that evaluated the last design
};

// A worker's part of a checkpoint.
struct KeptWorkers {
  WorkersState state;
  std::vector<const Mesh*> meshes;  // each worker's, then the hub; as long as the workers are not at work
};

// The parts of a run that workers need; they must outlive them, as the options must.
struct Evaluating {
  const DesignSpace& space;
  Evaluator& evaluator;
  const OptimiseOptions& options;
  std::size_t population;  // of the designer
  StepObserver& observer;  // of evaluations
};

class Workers {
 public:
  // All start on one mesh, of the space's start.
  Workers(const Evaluating& evaluating, const Mesh& mesh);
  // From a checkpoint, with what state() and meshes() gave; source: for errors.
  Workers(const Evaluating& evaluating, const WorkersState& state, std::vector<Mesh> meshes,
          const std::string& source);
  ~Workers();
  Workers(Workers&&) noexcept;

  std::size_t count() const;
  // Before the first design of a generation is evaluated; centre: of the designer, if it is feasible.
  void begin_generation(const std::optional<std::vector<double>>& centre);
  // Evaluates all jobs; those of one generation, in the order in which they were sampled. If a step throws,
  // the first such worker's exception is thrown when all have ended. (Evaluations that throw are results.)
  void evaluate(std::vector<Job>& jobs);

  const Mesh& last_mesh() const;  // of the last design
  const std::vector<double>& design_of_last_mesh() const;
  std::vector<const Mesh*> meshes() const;  // each worker's, then the hub
  WorkersState state() const;
  // Where evaluate() was interrupted and the options' keep_finished is set: with `before`, what state() gave
  // before, the state after the first jobs alone, of which all are finished; but meshes, and what belongs to
  // them, are those after the last finished job of each worker.
  KeptWorkers kept(WorkersState before, std::span<const Job> first) const;

  // The work of the crew that OptimiseOptions::ranks has designs evaluated by, on meshes that it is sent.
  // Space, evaluator and options must outlive it; these have no ranks.
  static CrewWork work_of_crew(const DesignSpace& space, Evaluator& evaluator, const OptimiseOptions& options,
                               std::size_t population);

 private:
  struct Crew;
  std::unique_ptr<Crew> crew_;
};

// The options' number of workers, or as many as samples per generation.
std::size_t worker_count(const OptimiseOptions& options, std::size_t population);
// The number of meshes in a checkpoint of such a run: one per worker, and the hub.
std::size_t mesh_count(const OptimiseOptions& options, std::size_t population);

}  // namespace remodel
