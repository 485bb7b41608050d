// Pieces of the flow solver, at a disturbed state around NACA 0012 with 200 points, at Mach 0.5.

#include <benchmark/benchmark.h>

#include <cmath>

#include "flow/scheme/flow_system.h"
#include "remodel/generate.h"

namespace {

using namespace remodel;

struct Case {
  flow::FlowMesh mesh{
      generate(airfoil_domain(named_airfoil("naca:0012", 5), {.points = 200}), {.gradation = 4.0})
          .mesh.freeze(),
      "farfield", "mesh"};
  flow::FlowSystem system{mesh, {.mach = 0.5, .alpha = 0.02}};
  flow::State state = system.undisturbed();
  Case() {
    for (std::size_t v = 0; v < state.q.size(); ++v)
      for (std::size_t k = 0; k < flow::unknown_count; ++k)
        state.q[v][k] += 1e-2 * std::sin(static_cast<double>(3 * v + k));
  }
};

const Case& of_mesh() {
  static const Case made;
  return made;
}

void count_edges(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(of_mesh().mesh.edges().size()));
}

// An iteration is the residual of the whole mesh, an item an edge.
void flow_residual(benchmark::State& state) {
  flow::Vector residual;
  for (auto _ : state) of_mesh().system.residual(of_mesh().state, residual);
  count_edges(state);
}
BENCHMARK(flow_residual)->Unit(benchmark::kMillisecond);

// An iteration is the Jacobian of the whole mesh, an item an edge.
void flow_jacobian(benchmark::State& state) {
  flow::BlockRows matrix = of_mesh().system.pattern();
  for (auto _ : state) of_mesh().system.jacobian(of_mesh().state, matrix);
  count_edges(state);
}
BENCHMARK(flow_jacobian)->Unit(benchmark::kMillisecond);

// An iteration is the derivatives of one weighted sum of residuals by all places, an item an edge.
void flow_shape_derivative(benchmark::State& state) {
  const std::vector<flow::Vector> weight(1, of_mesh().state.q);
  for (auto _ : state) benchmark::DoNotOptimize(of_mesh().system.residual_slopes(of_mesh().state, weight));
  count_edges(state);
}
BENCHMARK(flow_shape_derivative)->Unit(benchmark::kMillisecond);

// An iteration is the convective flux's derivatives at one face between states of the mesh, by hand and by
// dual numbers over all local unknowns.
template <class Derivative>
void differentiate(benchmark::State& state, Derivative derivative) {
  const auto& [mesh, system, q] = of_mesh();
  const flow::ConvectiveFlux term = {.limiter = 30.0, .slopes = 1.0};
  std::size_t e = 0;
  for (auto _ : state) {
    const flow::DualEdge& edge = mesh.edges()[e++ % mesh.edges().size()];
    const Point d = mesh.points()[edge.b] - mesh.points()[edge.a];
    const flow::FaceInputs<double, double> in = {
        .end = {flow::EdgeEnd::inner, flow::EdgeEnd::inner},
        .q = {q.q[edge.a], q.q[edge.b]},
        .along = {{0.01, 0.002, 0.003, 0.01}, {0.011, 0.001, -0.003, 0.02}},
        .normal = edge.normal,
        .edge = d,
        .length = 1.0};
    benchmark::DoNotOptimize(derivative(term, in));
  }
}
void face_derivative_by_hand(benchmark::State& state) {
  differentiate(state, [](const auto& term, const auto& in) { return term.derivative(in); });
}
BENCHMARK(face_derivative_by_hand);
void face_derivative_general(benchmark::State& state) {
  differentiate(state, [](const auto& term, const auto& in) { return general_derivative(term, in); });
}
BENCHMARK(face_derivative_general);

}  // namespace
