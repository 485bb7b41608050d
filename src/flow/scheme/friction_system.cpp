#include "flow/scheme/friction_system.h"

#include <algorithm>
#include <cmath>

#include "flow/scheme/friction_jacobian.h"
#include "flow/scheme/friction_slopes.h"
#include "flow/scheme/image_rows.h"

namespace remodel::flow {

template <std::size_t N>
BlockState<N> FrictionSystem<N>::start(double thickness) const {
  BlockState<N> state;
  state.augmented = {0.0, stream_.alpha};
  state.q.resize(dual_.size());
  for (std::size_t v = 0; v < dual_.size(); ++v) {
    const double part = std::tanh(mesh_.distances()[v] / thickness);
    const double speed = part * stream_.mach;
    double warmth = 1.0 + 0.5 * (gas_gamma - 1.0) * (stream_.mach * stream_.mach - speed * speed);
    // Temperature as it follows the speed at a Prandtl number of 1 (Crocco and Busemann).
    if (stream_.wall_temperature)
      warmth += (1.0 - part) *
                (*stream_.wall_temperature - 1.0 - 0.5 * (gas_gamma - 1.0) * stream_.mach * stream_.mach);
    Row& q = state.q[v];
    q[0] = 1.0 / warmth, q[3] = 1.0 / gas_gamma;
    q[1] = speed * std::cos(stream_.alpha), q[2] = speed * std::sin(stream_.alpha);
    if constexpr (N == 5) {
      // Some turbulence near walls: from the stream's alone boundary layers separate before it has grown. A
      // third of what the logarithmic layer has.
      constexpr double part_of_log_layer = 0.005;
      const double d = mesh_.distances()[v];
      q[4] = part * FrictionTerms::stream_working +
             part_of_log_layer * stream_.mach / terms_.viscosity.stream * d * std::exp(-d / thickness) /
                 FrictionTerms::working_unit;
    }
  }
  copy_to_images(dual_, state.q);
  return state;
}

// From the value at an end of edge e towards its middle.
template <std::size_t N>
std::array<double, N> FrictionSystem<N>::step(const BlockVector<N>& q, std::size_t e,
                                              std::size_t side) const {
  Row result = {};
  const DualEdge& edge = dual_.edges()[e];
  const double limited = limited_part<double>(FrictionTerms::gas(q[edge.a]), FrictionTerms::gas(q[edge.b]));
  const double width = limited > 0.0 ? terms_.limiter_width(dual_.vector(edge)) : 0.0;
  Row upwind = {};
  for (const WeightedVertex& of : mesh_.upwind(e, side))
    for (std::size_t k = 0; k < N; ++k) upwind[k] += of.weight * q[of.vertex][k];
  for (std::size_t k = 0; k < N; ++k) {
    const double central = q[edge.b][k] - q[edge.a][k];
    const double to = k < unknown_count ? terms_.step(upwind[k], central, width, limited)
                                        : terms_.working_step(upwind[k], central);
    result[k] = side == 0 ? to : -to;
  }
  return result;
}

template <std::size_t N>
void FrictionSystem<N>::unbalanced(const BlockState<N>& state, BlockVector<N>& out) const {
  out.assign(dual_.size(), {});
  const auto add = [&](std::uint32_t v, double factor, const Row& flux) {
    for (std::size_t k = 0; k < N; ++k) out[v][k] += factor * flux[k];
  };
  for (std::size_t e = 0; e < dual_.edges().size(); ++e) {
    const DualEdge& edge = dual_.edges()[e];
    Row value[2] = {state.q[edge.a], state.q[edge.b]};
    for (std::size_t side = 0; side < 2; ++side) {
      const Row to = step(state.q, e, side);
      const Row vertex = value[side];
      for (std::size_t k = 0; k < N; ++k) value[side][k] += to[k];
      for (const std::size_t k : positive_unknowns)
        value[side][k] = positivity_limited(value[side][k], vertex[k]);
    }
    const Row flux =
        terms_.template face_flux<double, N>(value[0], value[1], PlaneVector<double>(edge.normal));
    add(edge.a, 1.0, flux), add(edge.b, -1.0, flux);
  }
  for (const CornerTriangle& triangle : mesh_.triangles()) {
    const auto flux = terms_.template triangle<double, N>(triangle_states(state.q, triangle), triangle,
                                                          turbulent_corners(triangle));
    for (std::size_t i = 0; i < 3; ++i) add(triangle.corner[i], 1.0, flux[i]);
  }
  for (std::size_t v = 0; N == 5 && v < dual_.size(); ++v)
    if (has_turbulence(v))
      out[v][N - 1] -= terms_.template made<double, N, double>(state.q[v], vorticity(state.q, v),
                                                               mesh_.area(v), wall_place(v));
  for (const BoundaryEdge& edge : dual_.boundary())
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t here = i == 0 ? edge.a : edge.b;
      add(here, 1.0,
          terms_.template boundary_flux<double, N>(dual_.patch(edge), boundary_inputs<double>(state, edge, i),
                                                   state.q[here], stream_));
    }
  for (std::size_t v = 0; v < stream_.source.size(); ++v)
    for (std::size_t k = 0; k < unknown_count; ++k) out[v][k] -= stream_.source[v][k];
}

template <std::size_t N>
void FrictionSystem<N>::make_walls_strong(const BlockState<N>& state, BlockVector<N>& unbalanced) const {
  for (std::size_t v = 0; v < dual_.size(); ++v)
    for (std::size_t k = 0; k < N; ++k)
      if (mesh_.sticks(v) && is_strong(k)) {
        unbalanced[v][k] = state.q[v][k];
        if (k == 3) unbalanced[v][k] -= *stream_.wall_temperature / gas_gamma * state.q[v][0];
      }
}

template <std::size_t N>
void FrictionSystem<N>::residuals(const BlockState<N>& state, BlockVector<N>& of_vertices,
                                  Augmented& augmented) const {
  unbalanced(state, of_vertices);
  augmented = {forces(state, of_vertices).lift - state.augmented[0],
               stream_.lift ? state.augmented[0] - *stream_.lift : state.augmented[1] - stream_.alpha};
  make_walls_strong(state, of_vertices);
  set_image_rows(dual_, state.q, of_vertices);
}

template <std::size_t N>
double FrictionSystem<N>::mass_flow(const BlockState<N>& state, std::uint32_t patch) const {
  double sum = 0.0;
  for (const BoundaryEdge& edge : dual_.boundary())
    for (std::size_t i = 0; edge.patch == patch && i < 2; ++i)
      sum -=
          terms_.template boundary_flux<double, N>(dual_.patch(edge), boundary_inputs<double>(state, edge, i),
                                                   state.q[i == 0 ? edge.a : edge.b], stream_)[0];
  return sum;
}

template <std::size_t N>
WallForces FrictionSystem<N>::forces(const BlockState<N>& state, const BlockVector<N>& unbalanced,
                                     std::uint32_t patch) const {
  Point by_pressure = {}, by_friction = {};
  double turning = 0.0;
  const auto add = [&](Point& to, Point force, Point at) {
    to = to + force;
    turning += cross(at - stream_.reference, force);
  };
  // A vertex where walls of two patches meet has of each the part that its edges have there.
  std::vector<double> length(dual_.size(), 0.0);
  const auto length_of = [&](const BoundaryEdge& edge) {
    const Point d = dual_.points()[edge.b] - dual_.points()[edge.a];
    return std::sqrt(dot(d, d));
  };
  for (const BoundaryEdge& edge : dual_.boundary())
    if (dual_.patch(edge).solid()) length[edge.a] += length_of(edge), length[edge.b] += length_of(edge);
  for (const BoundaryEdge& edge : dual_.boundary()) {
    if (!dual_.patch(edge).solid() || (patch != no_index && edge.patch != patch)) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t here = i == 0 ? edge.a : edge.b, there = i == 0 ? edge.b : edge.a;
      const double p =
          0.75 * (state.q[here][3] - 1.0 / gas_gamma) + 0.25 * (state.q[there][3] - 1.0 / gas_gamma);
      add(by_pressure, p * edge.half[i], 0.75 * dual_.points()[here] + 0.25 * dual_.points()[there]);
      if (mesh_.sticks(here))
        add(by_friction, (length_of(edge) / length[here]) * friction_force(unbalanced, here),
            dual_.points()[here]);
    }
  }
  const double ca = std::cos(state.augmented[1]), sa = std::sin(state.augmented[1]);
  const double scale = 1.0 / (0.5 * stream_.mach * stream_.mach * stream_.length);
  const Point force = by_pressure + by_friction;
  return {.lift = scale * (force.y * ca - force.x * sa),
          .drag = scale * (force.x * ca + force.y * sa),
          .moment = -scale * turning / stream_.length,
          .pressure_drag = scale * (by_pressure.x * ca + by_pressure.y * sa)};
}

template <std::size_t N>
std::vector<double> FrictionSystem<N>::wave_speeds(const BlockState<N>& state) const {
  std::vector<double> sum(dual_.size(), 0.0);
  const auto speed = [&](std::uint32_t v, Point normal) {
    return wave_speed(FrictionTerms::gas(state.q[v]), normal);
  };
  for (const DualEdge& edge : dual_.edges()) {
    sum[edge.a] += 0.5 * speed(edge.a, edge.normal);
    sum[edge.b] += 0.5 * speed(edge.b, edge.normal);
  }
  for (const BoundaryEdge& edge : dual_.boundary()) {
    sum[edge.a] += 0.25 * speed(edge.a, edge.normal);
    sum[edge.b] += 0.25 * speed(edge.b, edge.normal);
  }
  copy_to_images(dual_, sum);
  return sum;
}

template <std::size_t N>
std::array<double, N> FrictionSystem<N>::conserved_at(const Row& q) {
  const Fluxes<double> gas = conserved<double>(FrictionTerms::gas(q));
  Row result;
  for (std::size_t k = 0; k < unknown_count; ++k) result[k] = gas[k];
  if constexpr (N == 5) result[4] = q[0] * q[4];
  return result;
}

template <std::size_t N>
SquareBlock<N> FrictionSystem<N>::conserved_slope(const Row& q) {
  using T = Dual<unknown_count>;
  Unknowns<T> in;
  for (std::size_t k = 0; k < unknown_count; ++k) in[k] = T::variable(q[k], k);
  const Fluxes<T> gas = conserved<T>(in);
  SquareBlock<N> result = {};
  for (std::size_t i = 0; i < unknown_count; ++i)
    for (std::size_t k = 0; k < unknown_count; ++k) result[N * i + k] = gas[i].slope[k];
  if constexpr (N == 5) result[N * 4] = q[4], result[N * 4 + 4] = q[0];
  return result;
}

template class FrictionSystem<4>;
template class FrictionSystem<5>;

}  // namespace remodel::flow
