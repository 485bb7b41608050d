#pragma once

// The meshes of a run: each worker has a living mesh of its own, and evaluates the designs that it is handed
// one after the other. Threads take workers, so that a worker's mesh never depends on their number.
//
// Which worker evaluates a design: those of a generation are handed out in the order in which they were
// sampled. Each goes to the worker whose last design is nearest, that is with the smallest displacement to it
// (design_profile.h), of several the first; but no worker takes more than its share of a generation, the
// population over the number of workers, rounded up. Nothing looks ahead: where a generation is evaluated in
// parts, with a checkpoint in between, the same workers evaluate the same designs.

#include <memory>
#include <optional>
#include <vector>

#include "optimise/design_profile.h"
#include "optimise/hub.h"
#include "optimise/mesh_chain.h"
#include "optimise/regeneration_rule.h"
#include "optimise/threads.h"
#include "remodel/optimise.h"

namespace remodel {

// A design to be evaluated, and what came out.
struct Job {
  CstAirfoil design;
  StepTasks tasks;
  EvaluationRecord record;  // step() fills in the mesh's part, Workers the worker
  // Anything but done: the mesh could not be finished, and the designs that its worker was to evaluate after
  // this one were not.
  Stopped stopped = Stopped::done;
  double squared_displacement = 0.0;  // from its worker's last design, where that matters
};

// What a worker goes on from beside its mesh.
struct WorkerState {
  std::vector<double> coefficients;  // of its last design
  std::uint64_t evaluated = 0;       // of this generation
  std::uint64_t full_adjustments = 0;
  RegenerationRule::Row row = 0;
  bool checked = false;  // its mesh, as a whole, since the start
};

struct WorkersState {
  std::vector<WorkerState> workers;
  std::uint64_t last = 0;  // the one that evaluated the last design
};

class Workers {
 public:
  // All start on one mesh, around the design `from`. The options must outlive the workers; population:
  // samples a generation.
  Workers(const OptimiseOptions& options, std::size_t population, const CstAirfoil& from, const Mesh& mesh);
  // From a checkpoint, with what state() and meshes() gave. like: a design of the family.
  Workers(const OptimiseOptions& options, std::size_t population, const CstAirfoil& like,
          const WorkersState& state, std::vector<Mesh> meshes);
  ~Workers();
  Workers(Workers&&) noexcept;

  std::size_t count() const;
  // Before the first design of a generation is evaluated; mean: of the distribution, if it is feasible.
  void begin_generation(const std::optional<CstAirfoil>& mean);
  // Evaluates all jobs; those of one generation, in the order in which they were sampled. If a step throws,
  // the first such worker's exception is thrown when all have ended.
  void evaluate(std::vector<Job>& jobs);

  const Mesh& last_mesh() const;            // of the last design
  std::vector<const Mesh*> meshes() const;  // each worker's, then the hub
  WorkersState state() const;

 private:
  struct Crew;
  std::unique_ptr<Crew> crew_;
};

// As the options say, or as many as samples a generation.
std::size_t worker_count(const OptimiseOptions& options, std::size_t population);
// What a checkpoint of such a run holds: a mesh a worker, and the hub.
std::size_t mesh_count(const OptimiseOptions& options, std::size_t population);

}  // namespace remodel
