#include "flow/scheme/flow_system.h"
#include "flow/scheme/forces.h"
#include "flow/scheme/image_rows.h"

namespace remodel::flow {

State FlowSystem::undisturbed() const {
  State state;
  state.augmented = {0.0, stream_.alpha};
  state.q.assign(mesh_.size(), stream_around<double>({0.0, 0.0}, stream_.mach, stream_.alpha, 0.0));
  return state;
}

std::vector<Unknowns<Point>> FlowSystem::gradients(const State& state) const {
  std::vector<Unknowns<Point>> gradient(mesh_.size());
  for (std::size_t v = 0; v < mesh_.size(); ++v) {
    Unknowns<Point> sum = {};
    for (const RingEntry& entry : mesh_.ring(v))
      for (std::size_t k = 0; k < unknown_count; ++k) {
        const double step = state.q[entry.vertex][k] - state.q[v][k];
        sum[k].x += entry.weight.x * step;
        sum[k].y += entry.weight.y * step;
      }
    gradient[v] = sum;
  }
  return gradient;
}

FaceInputs<double, double> FlowSystem::face_inputs(const State& state, const DualEdge& edge,
                                                   std::span<const Unknowns<Point>> gradients) const {
  const Point d = mesh_.vector(edge);
  FaceInputs<double, double> in = {.end = {end_of(mesh_, edge.a, edge.b), end_of(mesh_, edge.b, edge.a)},
                                   .q = {state.q[edge.a], state.q[edge.b]},
                                   .along = {},
                                   .normal = edge.normal,
                                   .edge = d,
                                   .length = stream_.length};
  const std::array<std::uint32_t, 2> sources = gradient_sources(mesh_, edge);
  for (std::size_t side = 0; side < 2; ++side) {
    const std::uint32_t source = sources[side];
    if (!gradients.empty()) {
      for (std::size_t k = 0; k < unknown_count; ++k) in.along[side][k] = dot(gradients[source][k], d);
      continue;
    }
    for (const RingEntry& entry : mesh_.ring(source)) {
      const double w = dot(entry.weight, d);
      for (std::size_t k = 0; k < unknown_count; ++k)
        in.along[side][k] += w * (state.q[entry.vertex][k] - state.q[source][k]);
    }
  }
  return in;
}

void FlowSystem::residual(const State& state, Vector& out) const {
  out.assign(mesh_.size(), {});
  const std::vector<Unknowns<Point>> gradient = gradients(state);
  for (const DualEdge& edge : mesh_.edges()) {
    const Fluxes<double> flux = flux_of(terms_, face_inputs(state, edge, gradient));
    for (std::size_t k = 0; k < unknown_count; ++k) out[edge.a][k] += flux[k], out[edge.b][k] -= flux[k];
  }
  for (const BoundaryEdge& edge : mesh_.boundary())
    for (std::size_t i = 0; i < 2; ++i) {
      const Fluxes<double> flux = mesh_.patch(edge).flux(boundary_inputs<double>(state, edge, i), stream_);
      for (std::size_t k = 0; k < unknown_count; ++k) out[i == 0 ? edge.a : edge.b][k] += flux[k];
    }
  for (std::size_t v = 0; v < stream_.source.size(); ++v)
    for (std::size_t k = 0; k < unknown_count; ++k) out[v][k] -= stream_.source[v][k];
  set_image_rows(mesh_, state.q, out);
}

Augmented FlowSystem::augmented_residual(const State& state) const {
  return {coefficients(*this, state).lift - state.augmented[0],
          stream_.lift ? state.augmented[0] - *stream_.lift : state.augmented[1] - stream_.alpha};
}

std::vector<double> FlowSystem::mass_flows(const State& state) const {
  std::vector<double> flows(mesh_.patches().size(), 0.0);
  for (const BoundaryEdge& edge : mesh_.boundary())
    for (std::size_t i = 0; i < 2; ++i)
      flows[edge.patch] -= mesh_.patch(edge).flux(boundary_inputs<double>(state, edge, i), stream_)[0];
  return flows;
}

std::vector<double> FlowSystem::wave_speeds(const State& state) const {
  std::vector<double> sum(mesh_.size(), 0.0);
  for (const DualEdge& edge : mesh_.edges()) {
    sum[edge.a] += 0.5 * wave_speed(state.q[edge.a], edge.normal);
    sum[edge.b] += 0.5 * wave_speed(state.q[edge.b], edge.normal);
  }
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    sum[edge.a] += 0.25 * wave_speed(state.q[edge.a], edge.normal);
    sum[edge.b] += 0.25 * wave_speed(state.q[edge.b], edge.normal);
  }
  copy_to_images(mesh_, sum);
  return sum;
}

}  // namespace remodel::flow
