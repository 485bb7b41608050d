#include "flow/search/potential_start.h"

#include <algorithm>
#include <cmath>

#include "flow/search/policy.h"
#include "remodel/error.h"
#include "remodel/potential_flow.h"

namespace remodel::flow {

namespace {

bool may_be_potential(const FlowSystem& system) {
  const Stream& stream = system.stream();
  if (stream.mach > SearchPolicy::most_mach_of_potential || stream.prescribed || !stream.source.empty())
    return false;
  return system.mesh().has_farfield() &&
         std::all_of(system.mesh().patches().begin(), system.mesh().patches().end(),
                     [](const Patch& patch) { return patch.is_farfield() || patch.solid(); });
}

FrozenMesh frozen_view(const FlowMesh& mesh) {
  FrozenMesh frozen;
  frozen.points = mesh.points();
  frozen.triangles = mesh.triangles();
  for (const Patch& patch : mesh.patches()) frozen.boundaries.push_back({patch.name, {}});
  for (const BoundaryEdge& edge : mesh.boundary())
    frozen.boundaries[edge.patch].edges.push_back({edge.a, edge.b});
  return frozen;
}

PotentialOptions options_of(const FlowSystem& system) {
  PotentialOptions options;
  options.farfield.clear();
  for (const Patch& patch : system.mesh().patches())
    if (patch.is_farfield()) options.farfield.push_back(patch.name);
  options.reference = system.stream().reference;
  options.reference_length = system.stream().length;
  return options;
}

// Of the stream's entropy and total enthalpy.
Unknowns<double> isentropic(Point velocity, double mach) {
  constexpr double half = 0.5 * (gas_gamma - 1.0), most = 0.9;
  const double total = 1.0 + half * mach * mach;
  const double largest = most * most * total / (1.0 + half * most * most);  // square of a speed
  const double square = dot(velocity, velocity);
  if (square > largest) velocity = std::sqrt(largest / square) * velocity;
  const double temperature = total - half * dot(velocity, velocity);
  const double density = std::pow(temperature, 1.0 / (gas_gamma - 1.0));
  return {density, velocity.x, velocity.y, density * temperature / gas_gamma};
}

}  // namespace

std::optional<State> potential_start(const FlowSystem& system) {
  if (!may_be_potential(system)) return std::nullopt;
  const Stream& stream = system.stream();
  try {
    const PotentialSolver solver(frozen_view(system.mesh()), options_of(system));
    const double alpha_deg =
        stream.lift ? solver.alpha_deg_for(*stream.lift, stream.mach) : stream.alpha / one_degree;
    const PotentialFlow potential = solver.at(alpha_deg, stream.mach);
    State state;
    state.augmented = {potential.lift, alpha_deg * one_degree};
    for (const Point velocity : potential.velocity)
      state.q.push_back(isentropic(stream.mach * velocity, stream.mach));
    return state;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace remodel::flow
