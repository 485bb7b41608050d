#pragma once

// The patches of a boundary. A condition is one file beside this one and a row in the variant.

#include <string>
#include <variant>

#include "flow/physics/boundary/far_field.h"
#include "flow/physics/boundary/inlet.h"
#include "flow/physics/boundary/no_slip_wall.h"
#include "flow/physics/boundary/outlet.h"
#include "flow/physics/boundary/periodic.h"
#include "flow/physics/boundary/slip_wall.h"
#include "flow/physics/boundary/symmetry.h"

namespace remodel::flow {

// Each has `kind`, what it is called in messages; `solid`, whether it is the wall of a body, whose
// pressures are forces; `bent`, whether the mesh bends its edges; `one_sided`, whether gradients at it are
// too one-sided to reconstruct with; `open`, whether the gas that passes it is reported; and `flux`, out of
// the domain through the half of an edge.
using BoundaryCondition = std::variant<SlipWall, FarField, Inlet, Outlet, Symmetry, NoSlipWall, Periodic>;

struct Patch {
  std::string name;
  BoundaryCondition condition;

  bool solid() const {
    return std::visit([](const auto& of) { return of.solid; }, condition);
  }
  bool bent() const {
    return std::visit([](const auto& of) { return of.bent; }, condition);
  }
  bool sticks() const { return std::holds_alternative<NoSlipWall>(condition); }
  bool one_sided() const {
    return std::visit([](const auto& of) { return of.one_sided; }, condition);
  }
  bool open() const {
    return std::visit([](const auto& of) { return of.open; }, condition);
  }
  const char* kind() const {
    return std::visit([](const auto& of) { return of.kind; }, condition);
  }
  bool is_outlet() const { return std::holds_alternative<Outlet>(condition); }
  bool is_periodic() const { return std::holds_alternative<Periodic>(condition); }
  bool is_farfield() const { return std::holds_alternative<FarField>(condition); }
  template <class T>
  Fluxes<T> flux(const BoundaryInputs<T>& in, const Stream& stream) const {
    return std::visit([&](const auto& of) { return of.flux(in, stream); }, condition);
  }
};

}  // namespace remodel::flow
