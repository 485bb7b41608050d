#pragma once

// States along a search: how large their residuals are, and how far a step may lead.

#include "flow/scheme/flow_system.h"

namespace remodel::flow {

// state + length * increment, where no density or pressure falls to less than a fifth by it.
State moved(const State& state, const Increment& increment, double length);

// The largest part of density or pressure that an increment changes anywhere; of what is nearly a vacuum, as
// a part of 0.05.
double largest_change(const State& state, const Increment& increment);

// A state's residuals and their size.
struct Residuals {
  Vector of_vertices = {};
  Augmented augmented = {};
  double size = 0.0;
  Increment negated() const;
};

// The size of residuals: of the flow's relative to undisturbed flow through the same mesh, and of the
// augmented equations'.
class Measure {
 public:
  explicit Measure(const FlowSystem& system);
  const FlowSystem& system() const { return system_; }
  // Their size is infinite where it is no state of a gas.
  Residuals operator()(const State& state) const;

 private:
  const FlowSystem& system_;
  double scale_;
};

}  // namespace remodel::flow
