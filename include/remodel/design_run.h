#pragma once

// Runs of design problems (remodel/design_problem.h): the search itself, what its directory tells afterwards,
// and its page.

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/design_problem.h"
#include "remodel/flow_space.h"
#include "remodel/history.h"
#include "remodel/optimise.h"

namespace remodel {

struct DesignRunOptions {
  std::filesystem::path directory{};  // of the run's files (optimise()); made if missing
  bool resume = false;                // go on from the directory's checkpoint
  bool overwrite = false;             // replace the run that the directory holds; not with resume
  std::size_t threads = 0;  // flows of points at the same time; times alone depend on it; 0: as many as cores
  // The crew that works on these, which does design_work(), finds the flows: each of its processes those of
  // some points, or, where the problem has several workers, those of the designs of some.
  PostedJobs* ranks = nullptr;
  // Called after each Newton step of every flow that this process looks for, from several threads: first
  // flows can take minutes.
  std::function<void(const FlowProgress&)> on_flow_step = {};
};

// A design's flow at one point, on a fresh mesh, which no search has seen. cl, cm: nan if undetermined.
struct FreshFlow {
  // This is what figures lack of those of an infinitely fine mesh, to be added to them: Richardson's estimate
  // by this mesh and the next coarser one (remodel/flow_error.h). Where lift is given that of cl is 0.
  struct Error {
    double cl = 0.0, cd = 0.0, cm = 0.0;
    double order = 2.0;  // of the errors: 1 where there is a supersonic region
  };
  int points = 0;  // on each section
  std::size_t vertices = 0;
  double mach = 0.0, alpha_deg = 0.0, cl = 0.0, cd = 0.0, cm = 0.0;
  std::optional<double> cd_pressure, cd_friction;  // with friction
  std::vector<NamedNumber> outlets;  // of a duct: mass_flow, and total_pressure as a part of the stream's
  std::string warning;               // what has to be known before these are used; mostly empty
  bool converged = false;
  std::vector<NamedNumber> violated;  // constraints of flows, by how much; within the tolerance they are not
  double seconds = 0.0;
  double mach_max = 0.0;            // the largest local Mach number
  std::optional<Error> error = {};  // on the finest of several meshes
};

// The search on one mesh of a problem with several, from coarse to fine.
struct DesignStage {
  int points = 0;
  double triangles = 0.0;                   // mean over its designs
  std::size_t evaluations = 0;              // designs
  std::optional<double> start_objective{};  // of its first design on its own mesh
  std::optional<double> objective{};        // of its best one
  double seconds = 0.0;                     // wall time, without fresh meshes
  std::string stopped;                      // DesignResult::stopped
};

struct DesignResult {
  OptimiseResult search;  // best_design, objective, outputs ...; its detail is of meshes and evaluations
  // "done" where the search has ended by itself; otherwise what stopped it or the verification:
  // "evaluations", "interrupted", "infeasible", or a mesh's limit.
  std::string stopped;
  bool converged = false;  // ended by itself, at a best design
  std::string detail;      // why there is no best design, and the search's own; or empty

  // Each says by how much the best design violates a constraint, 0 where that is within the tolerance, by
  // name. Where no design is within all constraints, they are those of the least violated one.
  std::vector<NamedNumber> constraints;
  std::vector<NamedNumber> named;  // numbers of the best design that have names, in their own units
  std::string best;                // the best design as best.json has it

  // Absent where the search has not evaluated the start, as CMA-ES does not.
  std::optional<double> start_objective;
  std::size_t flows = 0, gradients = 0;  // that were found
  std::size_t replacements = 0;          // designs for which triangles were replaced
  // Seconds of flows and gradients over those of the start's flows, which were found cold.
  std::optional<double> cold_equivalents;

  // There is one for each number in DesignProblem::verify, of each point; none where the verification was
  // interrupted.
  std::vector<FreshFlow> verified;        // the best design's
  std::vector<FreshFlow> verified_start;  // those of the design that the search began with, likewise
  // One for each mesh, where the problem has several (DesignProblem::coarse_points): all else here is of the
  // last one, and so are the files in the run's directory but stages.json and stage-1, stage-2 ..., the
  // directories of the coarse meshes' runs.
  std::vector<DesignStage> stages;
};

// Searches, with the meshes following by Strategy::reference, and evaluates the best design on fresh meshes
// at the end. The directory has what optimise() leaves there, and fresh.json (fresh_json()). A result is the
// same for the same problem, but for times. The observer is asked by flows and meshes too, between their
// steps, from several threads. Throws Error as validate() and optimise() do.
DesignResult run_design(const DesignProblem& problem, const DesignRunOptions& options,
                        OptimiseObserver* observer = nullptr);

// The work of a crew that finds the flows of such a search (DesignRunOptions::ranks). The result is that of
// threads, to the bit; where one of the crew is lost, its next flows begin anew, which leaves what the flows'
// tolerance says.
CrewWork design_work(const DesignProblem& problem);

// JSON arrays of objects.
std::string fresh_json(const std::vector<FreshFlow>& flows);
std::string stages_json(const std::vector<DesignStage>& stages);

// A run as its history has it.
struct DesignRun {
  std::string problem;    // JSON: design_problem_json(), but for designer and verification
  std::string objective;  // its name
  std::vector<std::string> constraint_names;  // of each function that an evaluation has
  double constraint_tolerance = 0.0;
  std::vector<EvaluationRecord> rows;
  std::size_t best = 0;   // row; without a best design the least violated one's, or the first
  bool has_flow = false;  // of that row; otherwise none of any design was found
  std::vector<DesignPoint> points;
  std::unique_ptr<const FlowSpace> space;
  std::vector<double> first_design;  // that the search began with, and whose mesh is the first one

  const std::vector<double>& best_design() const { return rows[best].coefficients; }
  bool has_best() const { return std::isfinite(rows[best].best_objective); }
  // This is the objective of the start, where the search evaluated it and found its flows.
  std::optional<double> start_objective() const;
  bool with_gradients() const { return rows.front().outputs.contains("gradient_seconds"); }
  double sum(const char* output) const;  // over all rows that have it
  // Each says by how much the design of `best` violates a constraint at its worst, by name.
  std::vector<NamedNumber> violations() const;
  // The text says why there is no best design: which constraint is violated most at the least violated
  // design, or that no flow was found.
  std::string why_no_design() const;
};

// True if the directory holds a run of a design problem, rather than another one of optimise().
bool holds_design_run(const std::filesystem::path& directory);
// Throws Error (file, format) for a directory that holds no such run.
DesignRun read_design_run(const std::filesystem::path& directory);

// Each says by how much a constraint is violated at its worst, 0 where that is within the tolerance, by name,
// in the order of the names. `names`: of each function, as constraint_names() has them.
std::vector<NamedNumber> violations_of(const std::vector<std::string>& names, double tolerance,
                                       const std::vector<double>& constraints);

// Closed polygons of the sections of a design, where they lie; of a deformed domain all loops but the far
// field.
std::vector<std::vector<Point>> outlines(const FlowSpace& space, std::span<const double> design);
// x0, y0, x1, y1 of what is worth seeing around the sections of the start and of the best design: `beside`
// and `above` parts of their common width more on each side. What is given for one section.
std::array<double, 4> window_of(const DesignRun& run, const std::array<double, 4>& of_one, double beside,
                                double above);

// Reads the run, finds the flows around its first and its best design once more, and writes one page (HTML)
// with everything in it: sections, pressures, Mach numbers, convergence, cost. Returns its figures as a JSON
// object. Throws Error (file, format) for a directory that holds no such run.
std::string write_design_page(const std::filesystem::path& run, const std::filesystem::path& page);

}  // namespace remodel
