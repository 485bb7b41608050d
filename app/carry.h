#pragma once

// Fields and solver states that are carried from one mesh to another: options, work and figures that `update`
// and `transfer` share.

#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "remodel/field.h"
#include "remodel/foam.h"
#include "remodel/frozen_mesh.h"
#include "remodel/su2_restart.h"
#include "remodel/transfer.h"
#include "report.h"

namespace remodel::app {

struct CarryOptions {
  std::string state, state_out;  // SU2's restart files or OpenFOAM's time directories; empty: none
  bool conservative = false;
  Outside outside = Outside::nearest;
};

// --state, --state-out, --conservative, --outside.
void add_carry_options(CLI::App& app, CarryOptions& options);

// What a solver knew on the mesh of a file.
class Cargo {
 public:
  // The file's fields, but for those with values that are not finite, and the state. Throws Error as the
  // readers do, and where the state is not of this mesh or one of the two options misses.
  Cargo(const std::string& file, const FrozenMesh& mesh, const CarryOptions& options);
  bool empty() const { return fields_.empty() && !state_ && !time_; }

  // From the mesh that it is on to another one. The same file as another mesh with the same points in another
  // order: `renumber`, which is no step and leaves no figures.
  void carry(const FrozenMesh& before, const FrozenMesh& after);
  void renumber(const FrozenMesh& before, const FrozenMesh& after);

  const std::vector<Field>& fields() const { return fields_; }
  void write_state(const FrozenMesh& mesh) const;  // where there is one
  // Nothing where nothing was carried.
  void add_figures(Report& report) const;

 private:
  struct Table;
  void move(const Transfer& transfer, FieldPlace place, bool conservative);
  void move_time(const Transfer& transfer, const FrozenMesh& before, const FrozenMesh& after,
                 bool conservative);
  void note_integrals(const FrozenMesh& mesh, Json& integrals) const;
  void note_balance(const std::vector<std::string>& names, const Balance& balance);
  std::vector<Field> with_state() const;
  std::vector<Field> in_cells() const;  // of a time directory, in the order in which they are carried

  CarryOptions options_;
  std::vector<Field> fields_;
  std::vector<std::string> left_out_;
  std::optional<Su2Restart> state_;
  std::optional<FoamTime> time_;
  Json figures_ = Json::object();
};

}  // namespace remodel::app
