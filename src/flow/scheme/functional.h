#pragma once

// Functions of a flow: sums over the halves of boundary edges, and what is made of them. One of them has
//
//   sums        how many;
//   includes()  whether a patch belongs to it;
//   local()     what one half adds to each sum: of states, places, the Mach number and the augmented
//   unknowns; total()     the function, of the sums, the Mach number and the angle of attack.
//
// Both are templates, written once; derivatives are those of dual numbers.

#include "flow/scheme/flow_system.h"

namespace remodel::flow {

// The derivatives of a function at fixed flow, and by the flow.
struct FunctionalSlope {
  ShapeSlope shape;
  Vector state;
  Augmented augmented = {};
};

// visit(edge number, half) on each half of the patches that belong to it.
template <class Functional, class Visit>
void for_each_half(const FlowSystem& system, const Functional& functional, Visit visit) {
  const FlowMesh& mesh = system.mesh();
  for (std::size_t e = 0; e < mesh.boundary().size(); ++e)
    if (functional.includes(mesh, mesh.boundary()[e].patch)) visit(e, 0), visit(e, 1);
}

template <class Functional>
std::array<double, Functional::sums> sums_of(const FlowSystem& system, const State& state,
                                             const Functional& functional) {
  std::array<double, Functional::sums> sums = {};
  for_each_half(system, functional, [&](std::size_t e, std::size_t half) {
    const auto part = functional.local(
        system.boundary_inputs<double>(state, system.mesh().boundary()[e], half), system.stream());
    for (std::size_t j = 0; j < sums.size(); ++j) sums[j] += part[j];
  });
  return sums;
}

template <class Functional>
double value(const FlowSystem& system, const State& state, const Functional& functional) {
  return functional.template total<double>(sums_of(system, state, functional), system.stream().mach,
                                           state.augmented[1], system.stream());
}

// The total by the sums, the Mach number and the angle of attack.
template <class Functional>
auto total_slopes(const FlowSystem& system, const State& state, const Functional& functional) {
  constexpr std::size_t count = Functional::sums;
  using T = Dual<count + 2>;
  const auto sums = sums_of(system, state, functional);
  std::array<T, count> in;
  for (std::size_t j = 0; j < count; ++j) in[j] = T::variable(sums[j], j);
  return functional
      .template total<T>(in, T::variable(system.stream().mach, count),
                         T::variable(state.augmented[1], count + 1), system.stream())
      .slope;
}

template <class Functional>
std::vector<AugmentedRows::Entry> slopes_by_unknowns(const FlowSystem& system, const State& state,
                                                     const Functional& functional) {
  constexpr std::size_t n = unknown_count;
  const auto by_sum = total_slopes(system, state, functional);
  std::vector<AugmentedRows::Entry> entries;
  for_each_half(system, functional, [&](std::size_t e, std::size_t half) {
    const BoundaryEdge& edge = system.mesh().boundary()[e];
    auto in = system.boundary_inputs<Dual<2 * n>>(state, edge, half);
    for (std::size_t k = 0; k < n; ++k) in.here[k].slope[k] = 1.0, in.there[k].slope[n + k] = 1.0;
    const auto part = functional.local(in, system.stream());
    Unknowns<double> by[2] = {};
    for (std::size_t j = 0; j < part.size(); ++j)
      for (std::size_t k = 0; k < n; ++k)
        by[0][k] += by_sum[j] * part[j].slope[k], by[1][k] += by_sum[j] * part[j].slope[n + k];
    entries.push_back({half == 0 ? edge.a : edge.b, by[0]});
    entries.push_back({half == 0 ? edge.b : edge.a, by[1]});
  });
  return entries;
}

template <class Functional>
FunctionalSlope slope_of(const FlowSystem& system, const State& state, const Functional& functional) {
  const FlowMesh& mesh = system.mesh();
  const auto by_sum = total_slopes(system, state, functional);
  FunctionalSlope result;
  result.shape.points.resize(mesh.size());
  result.state.resize(mesh.size());
  for (const AugmentedRows::Entry& entry : slopes_by_unknowns(system, state, functional))
    for (std::size_t k = 0; k < unknown_count; ++k) result.state[entry.vertex][k] += entry.by[k];
  result.shape.mach = by_sum[Functional::sums], result.augmented[1] = by_sum[Functional::sums + 1];
  FlowMesh::Slopes slopes;
  slopes.boundary.resize(mesh.boundary().size());
  for_each_half(system, functional, [&](std::size_t e, std::size_t half) {
    const BoundaryEdge& edge = mesh.boundary()[e];
    auto in = system.boundary_inputs<Dual<11>>(state, edge, half);
    std::size_t variable = 0;
    for (auto* of : {&in.half, &in.normal, &in.place_here, &in.place_there})
      of->x.slope[variable++] = 1.0, of->y.slope[variable++] = 1.0;
    for (auto* of : {&in.mach, &in.lift, &in.alpha}) of->slope[variable++] = 1.0;
    const auto part = functional.local(in, system.stream());
    std::array<double, 11> by = {};
    for (std::size_t j = 0; j < part.size(); ++j)
      for (std::size_t z = 0; z < by.size(); ++z) by[z] += by_sum[j] * part[j].slope[z];
    FlowMesh::Slopes::OfBoundary& of_edge = slopes.boundary[e];
    of_edge.half[half] = {by[0], by[1]};
    of_edge.normal = of_edge.normal + Point{by[2], by[3]};
    Point &here = result.shape.points[edge.place[half]], &there = result.shape.points[edge.place[1 - half]];
    here = here + Point{by[4], by[5]}, there = there + Point{by[6], by[7]};
    result.shape.mach += by[8], result.augmented[0] += by[9], result.augmented[1] += by[10];
  });
  mesh.add_slopes(slopes, result.shape.points);
  return result;
}

}  // namespace remodel::flow
