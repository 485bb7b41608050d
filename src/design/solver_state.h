#pragma once

// What a solver left of the last design of a living mesh, and the start that the next one gets of it: carried
// over to the new mesh or, where earlier states of the same connectivity are kept, combined of these.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/evaluator.h"
#include "remodel/foam.h"
#include "remodel/snapshots.h"
#include "remodel/su2_restart.h"

namespace remodel {

// The files in the directory of an evaluation that have a state.
struct StateFiles {
  std::string restart;     // empty: none
  bool foam_case = false;  // fields in the case of OpenFOAM
  bool any() const { return foam_case || !restart.empty(); }
};

// Which earlier states a start was made of.
struct StartRecord {
  std::size_t snapshots = 0;  // 0: the last state was carried over
  double misfit = 1.0;        // SnapshotStart::misfit
};

class SolverState final : public EvaluatorState {
 public:
  // What the solver left there; none where it left nothing. Throws Error where it cannot be read.
  static std::unique_ptr<SolverState> read(const std::filesystem::path& directory, const StateFiles& files,
                                           FrozenMesh mesh);
  // From bytes(); the mesh as it was then.
  static std::unique_ptr<SolverState> from(const std::string& bytes, FrozenMesh mesh,
                                           const std::string& source, std::size_t limit);
  std::string bytes() const override;

  // Keeps this state as one of the design, and of those that `before` has kept the latest, up to `limit`
  // altogether, if they belong to the same connectivity.
  void remember(SolverState* before, std::span<const double> design, std::size_t limit);
  // Writes a start for a design on another mesh.
  StartRecord write(const FrozenMesh& now, std::span<const double> design,
                    const std::filesystem::path& directory, const StateFiles& files) const;

 private:
  template <class State, class Visit>
  static void each_list(State& state, const Visit& visit);
  std::vector<double> values() const;
  bool same_numbers(const SolverState& other) const;
  void set_values(const std::vector<double>& values);
  bool keeps_positive(const SnapshotStart& start) const;

  FrozenMesh mesh_;
  std::optional<Su2Restart> restart_;
  std::optional<FoamTime> time_;
  std::optional<Snapshots> earlier_;  // on this connectivity, this state too; none: they are not wanted
};

}  // namespace remodel
