#pragma once

// Solves the augmented linear system [A B; D E] [x; z] = [r; g] with something that solves for A alone: z has
// two unknowns (State::augmented), B is dense and D sparse.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "flow/scheme/flow_system.h"

namespace remodel::flow {

using Vector = std::vector<std::array<double, 4>>;  // one block a vertex
using Augmented = std::array<double, 2>;

struct Increment {
  Vector q;
  Augmented augmented = {0, 0};
};

Increment zero(std::size_t vertices);
double inner(const Vector& a, const Vector& b);
double inner(const Increment& a, const Increment& b);
double norm(const Increment& a);
void add_times(Increment& to, double factor, const Increment& what);
// to += factor times the matrix times x, the r-th of `to` for its r-th row.
void add_product(const BlockRows& matrix, double factor, const Vector& x, Vector& to);

// x and the solutions y of A y = B for both columns. Not finite where the small system is singular.
Increment close_augmented(Vector x, const std::array<Vector, 2>& y, const FlowSystem::AugmentedRows& rows,
                          const Augmented& right);

// state + length * increment, where no density or pressure falls to less than a fifth by it.
State moved(const State& state, const Increment& increment, double length);

// The largest part of density or pressure that an increment changes anywhere; of what is nearly a vacuum, as
// a part of 0.05.
double largest_change(const State& state, const Increment& increment);

// The size of residuals: of the flow's relative to undisturbed flow through the same mesh, and of the
// augmented's.
class Measure {
 public:
  explicit Measure(const FlowSystem& system);
  // The residuals of a state; infinite where it is no state of a gas.
  double operator()(const State& state, Vector& residual, Augmented& augmented) const;

 private:
  const FlowSystem& system_;
  double scale_;
};

}  // namespace remodel::flow
