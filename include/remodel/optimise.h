#pragma once

// Shape interpolation by CMA-ES around one living mesh: the paper's section 5.1. Starting from one airfoil,
// the shape coefficients of both surfaces are changed until the design interpolates points of the target;
// every feasible sample is meshed by remodelling the mesh of the sample before. Where there are workers, each
// has a living mesh of its own.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/history.h"
#include "remodel/import.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

// A mesh to start from instead of a generated one: another program's, imported, or one that was written. It
// is remodelled to the start airfoil in the place of its own; all its other loops stay. Designs are in
// chords, meshes in the coordinates of the start mesh.
struct MeshStart {
  Mesh mesh;
  AirfoilPlace place;
};

// Which mesh a design's is made from.
enum class MeshUse {
  // The one that the same worker had for its design before.
  chain,
  // The hub: one mesh that is kept near the mean of the optimiser's distribution. Each design is tried on a
  // copy of it, which then returns to it. Losses are counted against the mesh that the same worker solved on
  // before: a triangle is preserved where the same three vertices, by id, at the same coordinates, are joined
  // in both. Meshes, unlike losses, do not depend on the number of workers.
  hub,
  // As chain, but for the designs that a criterion chooses the mesh is generated: the paper's section 5,
  // "Improvements". That is where a vertex of the last design and its place on this one are more than 8 local
  // length scales apart, and once after ten full adjustments in a row.
  regenerate,
};
const char* name_of(MeshUse use);  // "chain", "hub", "regenerate"

struct OptimiseOptions {
  AirfoilDomainOptions domain{};
  QualityOptions quality{};
  // Its observer is asked by all threads; designs_a_step is set from what follows.
  RemodelOptions remodel{.strategy = Strategy::renew};
  MeshUse use = MeshUse::chain;
  // Living meshes. The designs of a generation are handed to the workers whose last designs are nearest, and
  // evaluated at once. Meshes, rows and figures depend on it; designs do not. 0: as many as samples a
  // generation.
  std::size_t workers = 1;
  std::size_t threads = 0;  // nothing but times depends on it; 0: as many as cores. At most one a worker
  double sigma = 0.05;      // initial standard deviation of the coefficients; > 0
  std::uint64_t seed = 1;   // of the samples; the designs depend on nothing else of these options but
                            // sigma and, where samples are refused, on domain
  std::size_t evaluations = 9000;  // feasible samples, one remodelling each; at least 1
  std::size_t compare_every = 0;   // every K-th evaluation also generates a fresh mesh; 0: never
  // Every K-th mesh goes through check() too; 0: as compare_every. Of the others every 20th is checked as a
  // whole, as is each worker's first, by Mesh::quick_check(), and the rest by its rules where the step
  // changed them. `hub` checks all as a whole.
  std::size_t full_check_every = 0;
  std::size_t checkpoint_every =
      500;                          // evaluations between checkpoints; 0: at the start, the end, an interrupt
  std::size_t max_refused = 10000;  // infeasible samples in a row that end the run; at least 1
  bool resume = false;              // go on from the directory's checkpoint
  std::filesystem::path directory{};  // of the run's files; made if missing
  std::optional<MeshStart> start{};   // then domain and quality say nothing: the mesh has its own
};

// Why a run ended. Whatever it is, what is finished is kept.
enum class OptimiseStopped {
  done,         // all evaluations
  interrupted,  // OptimiseObserver::cancelled()
  infeasible,   // max_refused infeasible samples in a row
  mesh_limit,   // a mesh could not be finished within the quality options' budget
};
const char* name_of(OptimiseStopped stopped);  // "done", "interrupted", "infeasible", "mesh-limit"

// Figures without a measurement are NaN (null in JSON): those over compared evaluations if there was none.
struct OptimiseResult {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::uint64_t evaluations = 0;
  std::uint64_t infeasible_samples = 0;
  std::uint64_t full_adjustments = 0;
  double objective = none;  // of the best design: mean square distance in y, square chords
  double max_error = none;  // of the best design: largest distance in y at the interpolated points, chords
  double preserved_percent = none;         // mean over all evaluations
  double lost_mean = none;                 // triangles not preserved: mean over all evaluations
  double triangles_mean = none;            // over all evaluations
  double generated_triangles_mean = none;  // over the compared evaluations
  double surplus_percent = none;  // mean of (triangles - generated) / generated over the compared evaluations
  double gradation_bias = none,
         gradation_deviation = none;  // GradationError: means over the compared evaluations
  double generated_gradation_bias = none,
         generated_gradation_deviation = none;  // the same of the fresh meshes
  double remodel_ms_mean = none;     // over all evaluations, processor time of the thread, as the next one
  double generate_ms_mean = none;    // over the compared evaluations
  double speedup = none;             // generate_ms_mean / remodel_ms_mean
  double min_angle_deg = none;       // smallest of all meshes
  std::uint64_t invalid_meshes = 0;  // remodelled meshes that failed validation
  std::uint64_t recoveries = 0;      // evaluations whose mesh had to be regenerated
  std::uint64_t refreshes = 0;       // evaluations whose mesh the strategy generated afresh
  double seconds = 0.0;              // wall time, checks and files included, resumed parts added up

  std::uint64_t workers = 0;  // living meshes
  OptimiseStopped stopped = OptimiseStopped::done;
  std::string detail;  // the first broken rule or reason of a recovery, if any
  std::uint64_t seed = 0;
  CstAirfoil best;  // the evaluated design with the smallest objective
};

// One JSON object: the members above under their names, best as in airfoil_to_json.
std::string optimise_result_to_json(const OptimiseResult& result);

// Called from the thread that runs optimise().
class OptimiseObserver {
 public:
  virtual ~OptimiseObserver() = default;
  // After each evaluation.
  virtual void evaluated(const EvaluationRecord& record) { static_cast<void>(record); }
  // Asked before each evaluation, or where there are workers before those that they do at once; true ends the
  // run in order, with a checkpoint.
  virtual bool cancelled() { return false; }
};

// Runs, and leaves in the directory: history.sqlite; best.json (the best design); result.json; first.vtkhdf
// (the start), middle.vtkhdf (after half of the evaluations) and last.vtkhdf, native meshes; checkpoint.json
// and the meshes it names. Where there are workers, middle and last are meshes of the worker that evaluated
// that design.
//
// The search is over the coefficients of both surfaces; class exponents and trailing edges are fixed, and
// must be the same in both airfoils. Where their degrees differ the lower one is raised, which is exact. The
// objective is the mean square distance in y at 50 stations of each surface, x = (1 + cos 2 pi t) / 2 with t
// = i/102. A sample is infeasible, and sampled again, unless its surfaces are apart, its polygon's upper
// vertices lie above the lower ones, and it stays inside the farfield. With a start mesh, unless its surfaces
// are apart and the start mesh's domain is valid with it.
//
// With resume the run goes on to the designs, rows (but for their seconds) and meshes of a run that was not
// interrupted. All options but evaluations, checkpoint_every, max_refused and threads, and both airfoils,
// must be those of the checkpoint. Without resume, a directory that holds the checkpoint of an unfinished run
// is refused, and the files of a finished one are replaced, once the start of the new run is complete on the
// disk. A checkpoint, its mesh or a history that is damaged is refused before anything is written. One run at
// a time holds the directory, by flock; a second one is refused.
//
// Throws Error (argument, file, format, geometry). Both airfoils must have their surfaces apart.
OptimiseResult optimise(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options,
                        OptimiseObserver* observer = nullptr);

}  // namespace remodel
