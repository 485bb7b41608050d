#pragma once

// Optimisation around living meshes. A designer proposes designs and learns (remodel/designer.h), a design
// space says what shapes they are (remodel/design_space.h), living meshes follow them
// (remodel/living_mesh.h), an evaluator turns each mesh into an objective (remodel/evaluator.h). The loop
// itself, its run directory, history and checkpoints know none of them.
//
// The first of such runs is shape interpolation by CMA-ES, the paper's section 5.1: starting from one
// airfoil, the shape coefficients of both surfaces are changed until the design interpolates points of the
// target; every feasible sample is meshed by remodelling the mesh of the sample before.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/crew.h"
#include "remodel/design_space.h"
#include "remodel/designer.h"
#include "remodel/domain.h"
#include "remodel/evaluator.h"
#include "remodel/history.h"
#include "remodel/import.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"
#include "remodel/remodel.h"

namespace remodel {

// A mesh to start from instead of a generated one: another program's, imported, or one that was written. It
// is remodelled to the start airfoil in the place of its own; all its other loops stay. Designs are in
// chords, meshes in the coordinates of the start mesh.
struct MeshStart {
  Mesh mesh;
  AirfoilPlace place;
  // ReadNotes::su2_boxes of the mesh's file, without_surface_points(): first.vtkhdf, middle.vtkhdf and
  // last.vtkhdf keep them.
  std::string su2_boxes = {};
  // A mesh with layers has its walls here, in which the place is; `mesh` is its outer mesh, and
  // OptimiseOptions::layers has its layers' options.
  std::optional<Domain> walls = {};
};

// Layers of flat cells on the walls of all designs.
struct RunLayers {
  LayerOptions options;
  std::optional<WallSpacing> spacing = WallSpacing{};  // none: stations are the domain's own
  // Behind the start's walls; it stays there in all designs. None: a wake is what the domain has.
  std::optional<WakeLine> wake = {};
};

struct OptimiseOptions {
  AirfoilDomainOptions domain{};
  QualityOptions quality{};
  // Its observer is asked by all threads; strategy and designs_a_step are set from what follows.
  RemodelOptions remodel{};
  MeshStrategy strategy = MeshStrategy::renew;
  double reference_slack_deg = 2.0;  // of angle_with_slack(), for MeshStrategy::reference
  // Living meshes. The designs of a generation are handed to the workers whose last designs are nearest, and
  // evaluated at once. Meshes, rows and figures depend on it; designs do not. 0: the strategy's own number,
  // which is 1, but for `pool` as many as a generation has designs.
  std::size_t workers = 0;
  std::size_t threads = 0;  // nothing but times depends on it; 0: as many as cores. At most one a worker
  // Designs are evaluated by the crew that works on these, which does optimise_work(): then threads say
  // nothing.
  PostedJobs* ranks = nullptr;
  double sigma = 0.05;             // initial standard deviation of the coefficients; > 0
  std::uint64_t seed = 1;          // of the samples; the designs depend on nothing else of these options but
                                   // sigma and, where samples are refused, on domain
  std::size_t evaluations = 9000;  // feasible samples, one remodelling each; at least 1
  // The run is done after the generation in which the best objective is at most this (square chords), or in
  // which the search has converged; 0: only after all evaluations. Not one of the settings that a resumed run
  // has to have: the designs until then do not depend on it.
  double tolerance = 0.0;
  double constraint_tolerance = 0.0;  // a design is within a constraint that it violates by so much at most
  std::size_t compare_every = 0;      // every K-th evaluation also generates a fresh mesh; 0: never
  // Every K-th mesh goes through check() too; 0: as compare_every. Of the others every 20th is checked as a
  // whole, as is each worker's first, by Mesh::quick_check(), and the rest by its rules where the step
  // changed them. `hub` checks all as a whole.
  std::size_t full_check_every = 0;
  std::size_t checkpoint_every =
      500;  // evaluations between checkpoints; 0: at the start, the end, an interrupt
  // True for long evaluations: a copy of its mesh is kept before each of them, so that an interrupt within
  // one loses none that was finished. Where several workers are interrupted, rows end before the first design
  // that was not finished; those behind it that were are in the checkpoint, and are not evaluated again.
  bool keep_finished = false;
  // A design whose mesh meets a limit has failed, as one whose evaluation throws has, and the run goes on
  // from the mesh before it. With keep_finished, and without compare_every. Otherwise it ends the run.
  bool fail_at_limits = false;
  std::size_t max_refused = 10000;    // infeasible samples in a row that end the run; at least 1
  bool resume = false;                // go on from the directory's checkpoint
  bool overwrite = false;             // replace the run that the directory holds; not with resume
  std::filesystem::path directory{};  // of the run's files; made if missing
  // The first mesh is of this design; none: of the space's start. Not with `start`.
  std::vector<double> first_design{};
  std::optional<MeshStart> start{};  // then domain and quality say nothing: the mesh has its own
  // Runs of airfoils may have these. Living meshes are what lies beyond the layers, and so are the triangles
  // of histories and figures. The meshes that a run leaves, and those of evaluators that are programs, have
  // their layers. All designs have the same columns, with the fans of the start: layers are functions of the
  // designs alone.
  std::optional<RunLayers> layers{};
};

// Why a run ended. Whatever it is, what is finished is kept.
enum class OptimiseStopped {
  done,         // all evaluations, the tolerance, or Designer::finished()
  interrupted,  // OptimiseObserver::cancelled()
  infeasible,   // max_refused infeasible samples in a row
  mesh_limit,   // a mesh could not be finished within the quality options' budget (but see fail_at_limits)
};
const char* name_of(OptimiseStopped stopped);  // "done", "interrupted", "infeasible", "mesh-limit"

// Figures without a measurement are NaN (null in JSON): those over compared evaluations if there was none.
struct OptimiseResult {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::uint64_t evaluations = 0;
  std::uint64_t infeasible_samples = 0;
  std::uint64_t failed_evaluations = 0;
  std::uint64_t full_adjustments = 0;
  double objective = none;  // of the best design; by interpolation: mean square distance in y, square chords
  // Interpolation gives the best design's largest distance in y at the interpolated points, in chords.
  double max_error = none;
  double preserved_percent = none;         // mean over all evaluations
  double lost_mean = none;                 // triangles not preserved: mean over all evaluations
  double connectivity_percent = none;      // mean over all evaluations
  double connectivity_kept_steps = none;   // share of the steps in which no triangle was born or gone
  double changed_triangles_mean = none;    // triangles born and gone: mean over all evaluations
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
  std::string detail;  // the first broken rule, reason of a recovery or of a failed evaluation, if any
  std::uint64_t seed = 0;
  // The design with the smallest objective among those within all constraints; the start where there is none.
  std::vector<double> best_design;
  std::map<std::string, double> outputs;  // Evaluation::outputs of the best design
  CstAirfoil best;                        // by optimise() from an airfoil: the best design
};

inline constexpr std::tuple optimise_figures{
    Figure{"evaluations", "evaluations", "", &OptimiseResult::evaluations},
    Figure{"infeasible_samples", "infeasible samples, drawn again", "", &OptimiseResult::infeasible_samples},
    Figure{"failed_evaluations", "evaluations that failed", "", &OptimiseResult::failed_evaluations},
    Figure{"full_adjustments", "full adjustments", "", &OptimiseResult::full_adjustments},
    Figure{"objective", "best objective", "", &OptimiseResult::objective},
    Figure{"max_error", "largest distance to the target", "chords", &OptimiseResult::max_error},
    Figure{"preserved_percent", "preserved, mean", "%", &OptimiseResult::preserved_percent},
    Figure{"lost_mean", "lost, mean", "triangles", &OptimiseResult::lost_mean},
    Figure{"connectivity_percent", "joined as before, mean", "%", &OptimiseResult::connectivity_percent},
    Figure{"connectivity_kept_steps", "steps that kept the connectivity, share", "",
           &OptimiseResult::connectivity_kept_steps},
    Figure{"changed_triangles_mean", "born and gone, mean", "triangles",
           &OptimiseResult::changed_triangles_mean},
    Figure{"triangles_mean", "triangles, mean", "", &OptimiseResult::triangles_mean},
    Figure{"generated_triangles_mean", "of a fresh mesh, mean", "",
           &OptimiseResult::generated_triangles_mean},
    Figure{"surplus_percent", "surplus, mean", "%", &OptimiseResult::surplus_percent},
    Figure{"gradation_bias", "gradation error, mean bias", "", &OptimiseResult::gradation_bias},
    Figure{"gradation_deviation", "gradation error, mean deviation", "",
           &OptimiseResult::gradation_deviation},
    Figure{"generated_gradation_bias", "of a fresh mesh, bias", "",
           &OptimiseResult::generated_gradation_bias},
    Figure{"generated_gradation_deviation", "of a fresh mesh, deviation", "",
           &OptimiseResult::generated_gradation_deviation},
    Figure{"remodel_ms_mean", "remodelling, mean", "ms", &OptimiseResult::remodel_ms_mean},
    Figure{"generate_ms_mean", "generation, mean", "ms", &OptimiseResult::generate_ms_mean},
    Figure{"speedup", "speed-up", "times", &OptimiseResult::speedup},
    Figure{"min_angle_deg", "smallest angle of all meshes", "degrees", &OptimiseResult::min_angle_deg},
    Figure{"invalid_meshes", "invalid meshes", "", &OptimiseResult::invalid_meshes},
    Figure{"recoveries", "recoveries by generation", "", &OptimiseResult::recoveries},
    Figure{"refreshes", "meshes generated afresh by the strategy", "", &OptimiseResult::refreshes},
    Figure{"seconds", "wall time", "seconds", &OptimiseResult::seconds},
    Figure{"workers", "workers", "", &OptimiseResult::workers},
    Figure{"stopped", "stopped", "", &OptimiseResult::stopped},
    Figure{"detail", "detail", "", &OptimiseResult::detail},
    Figure{"seed", "seed", "", &OptimiseResult::seed}};

// One JSON object: the figures, "outputs" where there are any, and "best": of an airfoil as in
// airfoil_to_json, otherwise the design as an array.
std::string optimise_result_to_json(const OptimiseResult& result);

class OptimiseObserver {
 public:
  virtual ~OptimiseObserver() = default;
  // After each evaluation, from the thread that runs optimise().
  virtual void evaluated(const EvaluationRecord& record) { static_cast<void>(record); }
  // Asked before each evaluation, or where there are workers before those that they do at once; true ends the
  // run in order, with a checkpoint. Evaluations that take long ask too, from their own threads. Asked while
  // the first mesh is made too, before which there is no run: then nothing is left.
  virtual bool cancelled() { return false; }
};

// Runs, and leaves in the directory: history.sqlite; best.json (the best design, as the design space writes
// it); result.json; first.vtkhdf (the start), middle.vtkhdf and last.vtkhdf, native meshes; checkpoint.json
// and the files it names. The middle is where half of the evaluations are done; of a shape interpolation with
// a tolerance, where that is sooner, the end of the generation in which the best design is half as far from
// the target as the start (a quarter of its objective). Where there are workers, middle and last are meshes
// of the worker that evaluated that design; of interrupted workers the last is as far as that one had come.
//
// A sample that the design space finds infeasible is refused, and the designer is asked again.
//
// With resume the run goes on to the designs, rows (but for their seconds) and meshes of a run that was not
// interrupted. All options but evaluations, tolerance, checkpoint_every, keep_finished, max_refused and
// threads, and the descriptions of space, designer and evaluator must be those of the checkpoint. The
// designer comes as it was made, and is restored. Without resume, a directory that holds a run is refused;
// with overwrite its files are replaced, once the start of the new run is complete on the disk. A checkpoint,
// its mesh or a history that is damaged is refused before anything is written. One run at a time holds the
// directory, by flock; a second one is refused. Where evaluations are long a checkpoint is written at least
// about once a minute.
//
// The options domain, sigma and seed are not read here, and of a start mesh only the mesh is: the space has
// the rest. Throws Error (argument, file, format, geometry).
OptimiseResult optimise(const DesignSpace& space, Designer& designer, Evaluator& evaluator,
                        const OptimiseOptions& options, OptimiseObserver* observer = nullptr);

// Shape interpolation: an AirfoilSpace around `from`, a CmaesDesigner, and interpolation_evaluator(to). Class
// exponents and trailing edges are fixed, and must be the same in both airfoils; where their degrees differ
// the lower one is raised, which is exact. Both airfoils must have their surfaces apart.
OptimiseResult optimise(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options,
                        OptimiseObserver* observer = nullptr);

// This runs with an evaluator of one's own.
OptimiseResult optimise(const CstAirfoil& from, Evaluator& evaluator, const OptimiseOptions& options,
                        OptimiseObserver* observer = nullptr);

// The work of a crew that evaluates the designs of such a run (OptimiseOptions::ranks), made of the same
// arguments in each of its processes. A design goes there with its worker's mesh, and comes back with it. All
// of a crew have the same result as threads of one process, to the bit; where one of them is lost, evaluators
// whose states say more than their bytes begin without.
CrewWork optimise_work(const DesignSpace& space, Evaluator& evaluator, const OptimiseOptions& options,
                       std::size_t population);
CrewWork optimise_work(const CstAirfoil& from, const CstAirfoil& to, const OptimiseOptions& options);
CrewWork optimise_work(const CstAirfoil& from, Evaluator& evaluator, const OptimiseOptions& options);

// How a run's meshes are stepped: options.remodel with the step of options.strategy.
RemodelOptions step_options(const OptimiseOptions& options);

}  // namespace remodel
