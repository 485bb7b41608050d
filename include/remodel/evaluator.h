#pragma once

// The evaluator of a run: it turns a design's mesh, with the record of what changed on the way to it, and
// what it kept from the design before into an objective, constraints and, if it can, gradients. It knows
// nothing of how designs are found. Where there are several workers, evaluate() is called from several
// threads at once, each with the state of its own living mesh.
//
// examples/own_evaluator.cpp is one in thirty lines.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/evaluation.h"
#include "remodel/layers.h"
#include "remodel/living_mesh.h"
#include "remodel/mesh.h"

namespace remodel {

// The data that an evaluator keeps from design to design of one living mesh: a flow field, the factors of a
// matrix. Vertices that a step kept have kept their ids.
class EvaluatorState {
 public:
  virtual ~EvaluatorState() = default;
  // For a checkpoint: Evaluator::restore() makes the state of it. Empty: a resumed run begins without a
  // state.
  virtual std::string bytes() const { return {}; }
};

// One design to be evaluated.
struct EvaluationTask {
  std::span<const double> design;
  const Mesh& mesh;      // of the design, valid; where the run has layers, what lies beyond them
  const MeshStep& step;  // from the worker's design before to this one
  // mesh.changes_since(*before): what has changed since the worker's design before. Null where this mesh was
  // not made from that one's: it was generated instead, or is the hub's (MeshStrategy::hub).
  const Mark* before;
  bool gradient;  // whether the designer asks for gradients
  // To be asked now and then by evaluations that take long; an evaluation that throws after it has been told
  // that the run is cancelled did not fail. The run ends, to be resumed from its last checkpoint.
  StepObserver& observer;
  std::uint64_t evaluation = 0;  // its number in the run, from 1
  // Proposal::from: whatever was evaluated in between, that design's solution is where this one's is near.
  std::span<const double> from = {};
  // The mesh with its layers, made anew by every call; empty where the run has none.
  std::function<LayeredMesh()> with_layers = {};
  // The mesh as arrays, with its layers where it has some.
  FrozenMesh freeze(LayerCells cells = LayerCells::quadrilaterals) const {
    return with_layers ? with_layers().freeze(cells) : mesh.freeze();
  }
};

class Evaluator {
 public:
  virtual ~Evaluator() = default;

  // `state`: what this living mesh's last evaluation left there; null at the first one, and after one that
  // failed. An evaluation fails where evaluate() throws or returns an objective that is not finite or
  // gradients of another size: the design counts as infeasible (objective infinite), the history has the
  // message, the run goes on.
  virtual Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) = 0;

  // The state is made again from what EvaluatorState::bytes() gave; `mesh` is the mesh as it was then. Throws
  // Error (format) naming `source` where the bytes are damaged.
  virtual std::unique_ptr<EvaluatorState> restore(const std::string& bytes, const Mesh& mesh,
                                                  const std::string& source) {
    static_cast<void>(bytes), static_cast<void>(mesh), static_cast<void>(source);
    return nullptr;
  }
  // Runs with layers restore by this call, which, unless it says more, asks the one above with the outer
  // mesh.
  virtual std::unique_ptr<EvaluatorState> restore_layered(const std::string& bytes, const LayeredMesh& mesh,
                                                          const std::string& source) {
    return restore(bytes, mesh.outer(), source);
  }
  // A JSON object says what evaluations depend on: a run can be resumed with the same alone.
  virtual std::string description() const = 0;
};

// The paper's: the mean square distance in y, in square chords, to the target at 50 stations of each surface,
// x = (1 + cos 2 pi t) / 2 with t = i / 102. Designs are the coefficients of an AirfoilSpace of the target's
// degree, class exponents and trailing edge (remodel/design_space.h). With gradient; without constraints. It
// does not look at the mesh.
std::unique_ptr<Evaluator> interpolation_evaluator(const CstAirfoil& target);

// Which directories of evaluations are left.
enum class KeepEvaluations { none, failed, all };

struct CommandOptions {
  double time_limit = 0.0;  // seconds of wall time for one evaluation, after which it fails; 0: none
  // Directories of evaluations that are kept are in it, EvaluationTask::evaluation in six digits; it is made
  // if missing. While it runs, an evaluation is in running-XXXXXX there, which is new with each evaluator;
  // those of earlier ones are removed, so that only one at a time may have this directory. Empty: a temporary
  // one each, which is never kept.
  std::filesystem::path directory{};
  KeepEvaluations keep = KeepEvaluations::failed;
  // Most states of earlier designs that are kept with each living mesh, in memory and in checkpoints. As long
  // as its connectivity stays, the start of the next design is their combination (remodel/snapshots.h), but
  // the nearest one alone where a variable that is positive in all of them would not be so any more. The
  // evaluation's outputs then have "state_snapshots", how many were combined (0: there was no state, or the
  // connectivity had changed and the last one was carried over), and "state_misfit". 0: the last state alone.
  std::size_t snapshots = 0;
  std::string su2_boxes{};                              // WriteOptions::su2_boxes of mesh.su2 and mesh.vtkhdf
  LayerCells layer_cells = LayerCells::quadrilaterals;  // of meshes with layers, but for mesh.vtkhdf
};

// A program of the user's, run once for each design. In the words of the command
//   {mesh}       is the mesh, mesh.su2; {mesh.vtkhdf}, {mesh.msh}, {mesh.vtu}: in these formats
//   {design}     design.json, the design's parameters as an array
//   {state}      state.csv, SU2's restart file in ASCII, rows in the order of the mesh's points (also
//                {state.dat}, binary). It is there when this living mesh has been evaluated before and the
//                program left one: that one, carried over to the points of this mesh (Transfer::ride). What
//                the program leaves there is carried to the next design.
//   {case}       a case of OpenFOAM (remodel/foam.h): its mesh and, when this living mesh has been evaluated
//                before, the fields of the latest time directory above 0 that the program left there,
//                carried over within their bounds, as those of time 0
//   {result}     result.json, which the program is to write; otherwise it prints the result
//   {directory}  the directory of this evaluation, in which all of these are, with absolute paths
// A command without any of them is given {mesh} and {design} as its last two words. The program runs in the
// directory of this one. The result is one JSON object: "objective", a number, and optionally "constraints",
// an array of numbers, "gradient", an array, "constraint_gradients", an array of arrays, and "outputs", an
// object of numbers. The evaluation fails where the program cannot be started, ends with another status than
// 0 or is too slow, or where the result or state that it leaves cannot be read; the message has the end of
// what it wrote to standard error, which stays in the file `errors` where the directory is kept. Time limits
// and cancelled runs end the program; the next design of that mesh begins without a state. All processes of
// its group end with it, however it ends. Throws Error (argument) for an empty command, for formats that are
// not known, and for words in braces that are at most two letters off one of these, but for ${word}: all
// others are the shell's.
std::unique_ptr<Evaluator> command_evaluator(std::vector<std::string> command, CommandOptions options = {});

// A place is where a text names one of these files.
struct CommandPlace {
  std::size_t at, size;
  std::string file;  // in the directory of an evaluation; empty: that directory
};
std::vector<CommandPlace> command_places(std::string_view text);

}  // namespace remodel
