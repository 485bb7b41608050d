#pragma once

// Derivatives of flows with friction by places and by what is given of the stream: members of FrictionSystem,
// which friction_system.cpp instantiates. Reverse by hand across sums, forward dual numbers within one term,
// as shape_derivative.cpp.

#include <cmath>

#include "flow/scheme/friction_system.h"

namespace remodel::flow {

namespace {

// The weighted sum of derivatives by all variables.
template <std::size_t V, std::size_t N>
std::array<double, V> weighted_slope(const std::array<double, N>& weight,
                                     const std::array<Dual<V>, N>& flux) {
  std::array<double, V> by = {};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t z = 0; z < V; ++z) by[z] += weight[i] * flux[i].slope[z];
  return by;
}

}  // namespace

template <std::size_t N>
std::vector<ShapeSlope> FrictionSystem<N>::slopes_of_unbalanced(
    const BlockState<N>& state, std::span<const BlockVector<N>> weights) const {
  const std::size_t edges = dual_.edges().size();
  std::vector<ShapeSlope> results(weights.size(), {.points = std::vector<Point>(dual_.size())});
  std::vector<FlowMesh::Slopes> slopes(
      weights.size(), {.normal = std::vector<Point>(edges),
                       .weight = std::vector<Point>(2 * edges),
                       .boundary = std::vector<FlowMesh::Slopes::OfBoundary>(dual_.boundary().size())});
  add_face_slopes(state, weights, slopes, results);
  add_triangle_slopes(state, weights, results);
  for (std::size_t j = 0; j < weights.size(); ++j) {
    add_boundary_slopes(state, weights[j], slopes[j], results[j]);
    dual_.add_slopes(slopes[j], results[j].points);
  }
  add_stream_slopes(state, weights, results);
  return results;
}

// By normals, and by what upwind differences follow: lengths of the edge and of that to the opposite
// neighbour, or gradients.
template <std::size_t N>
void FrictionSystem<N>::add_face_slopes(const BlockState<N>& state, std::span<const BlockVector<N>> weights,
                                        std::span<FlowMesh::Slopes> slopes,
                                        std::span<ShapeSlope> results) const {
  using Kind = FrictionMesh::Upwind;
  const auto gas = [&](std::uint32_t v, std::size_t k) { return state.q[v][k]; };
  std::vector<std::array<Point, N>> gradient(dual_.size());
  for (std::uint32_t v = 0; v < dual_.size(); ++v)
    for (const RingEntry& entry : dual_.ring(v))
      for (std::size_t k = 0; k < N; ++k)
        gradient[v][k] = gradient[v][k] + (gas(entry.vertex, k) - gas(v, k)) * entry.weight;
  std::vector<std::vector<std::array<Point, N>>> by_gradient(weights.size(),
                                                             std::vector<std::array<Point, N>>(dual_.size()));
  for (std::size_t e = 0; e < dual_.edges().size(); ++e) {
    const DualEdge& edge = dual_.edges()[e];
    const Point d = dual_.vector(edge);
    const auto [flux, reconstructed, limited] = face_dual<2 * N + 2>(state, e, Order::whole);
    const double by_square = 3.0 * terms_.limiter_width(d) / dot(d, d);  // the limiter's width
    for (std::size_t j = 0; j < weights.size(); ++j) {
      Row w;
      for (std::size_t k = 0; k < N; ++k) w[k] = weights[j][edge.a][k] - weights[j][edge.b][k];
      const auto by = weighted_slope(w, flux);
      slopes[j].normal[e] = {by[2 * N], by[2 * N + 1]};
      std::vector<Point>& points = results[j].points;
      Point &from = points[edge.place[0]], &to = points[edge.place[1]];
      for (std::size_t side = 0; side < 2; ++side) {
        const auto [kind, behind, edge_behind] = mesh_.upwind_kind(e, side);
        if (limited.value > 0.0) {
          double by_width = 0.0;
          for (std::size_t k = 0; k < N; ++k) by_width += by[N * side + k] * reconstructed[side][k].slope[4];
          from = from - by_width * by_square * d, to = to + by_width * by_square * d;
          results[j].length -= by_width * by_square * dot(d, d) / terms_.extent;
        }
        if (kind == Kind::central) continue;
        const std::uint32_t here = side == 0 ? edge.a : edge.b;
        Row by_upwind;
        for (std::size_t k = 0; k < N; ++k) by_upwind[k] = by[N * side + k] * reconstructed[side][k].slope[2];
        Point by_d;
        if (kind == Kind::opposite) {
          const DualEdge& before = dual_.edges()[edge_behind];
          const std::size_t end = before.a == here ? 0 : 1;
          const Point back = (end == 0 ? -1.0 : 1.0) * dual_.vector(before);
          const double length = std::sqrt(dot(d, d)), length_back = std::sqrt(dot(back, back));
          double by_ratio = 0.0;
          for (std::size_t k = 0; k < N; ++k)
            by_ratio += (side == 0 ? 1.0 : -1.0) * by_upwind[k] * (gas(here, k) - gas(behind, k));
          by_d = (by_ratio / (length * length_back)) * d;
          const Point by_back = (-by_ratio * length / (length_back * length_back * length_back)) * back;
          Point &at = points[before.place[end]], &at_behind = points[before.place[1 - end]];
          at = at + by_back, at_behind = at_behind - by_back;
        } else {
          for (std::size_t k = 0; k < N; ++k) {
            by_gradient[j][here][k] = by_gradient[j][here][k] + 2.0 * by_upwind[k] * d;
            by_d = by_d + 2.0 * by_upwind[k] * gradient[here][k];
          }
        }
        from = from - by_d, to = to + by_d;
      }
    }
  }
  for (std::size_t j = 0; j < weights.size(); ++j)
    for (std::uint32_t v = 0; v < dual_.size(); ++v) {
      std::size_t i = dual_.ring_begin(v);
      for (const RingEntry& entry : dual_.ring(v)) {
        Point& by_weight = slopes[j].weight[i++];
        for (std::size_t k = 0; k < N; ++k)
          by_weight = by_weight + (gas(entry.vertex, k) - gas(v, k)) * by_gradient[j][v][k];
      }
    }
}

// What turbulence makes at each vertex, by the area that triangles share out to it, by the sum of shares
// times their vorticity, and by its distance from walls.
template <std::size_t N>
std::vector<typename FrictionSystem<N>::SourceSlope> FrictionSystem<N>::source_slopes(
    const BlockState<N>& state) const {
  std::vector<SourceSlope> result(dual_.size());
  using T = Dual<3>;
  for (std::size_t v = 0; N == 5 && v < dual_.size(); ++v) {
    if (!has_turbulence(v)) continue;
    Local<T, N> q;
    for (std::size_t k = 0; k < N; ++k) q[k] = T(state.q[v][k]);
    const T area = T::variable(mesh_.area(v), 0);
    const T turning = T::variable(mesh_.area(v) * vorticity(state.q, v), 1);
    const WallPlace<T> wall = {T::variable(mesh_.distances()[v], 2), mesh_.is_laminar(v)};
    const T made = terms_.template made<T, N, T>(q, turning / area, area, wall);
    result[v] = {made.slope[0], made.slope[1], made.slope[2]};
  }
  return result;
}

// By the places of the corners, and by their distances from walls.
template <std::size_t N>
void FrictionSystem<N>::add_triangle_slopes(const BlockState<N>& state,
                                            std::span<const BlockVector<N>> weights,
                                            std::span<ShapeSlope> results) const {
  using T = Dual<6>;
  std::vector<std::vector<double>> by_distance(weights.size(), std::vector<double>(dual_.size(), 0.0));
  const std::vector<SourceSlope> sources = source_slopes(state);
  for (std::size_t j = 0; N == 5 && j < weights.size(); ++j)
    for (std::size_t v = 0; v < dual_.size(); ++v)
      by_distance[j][v] -= weights[j][v][N - 1] * sources[v].distance;
  for (const CornerTriangle& triangle : mesh_.triangles()) {
    std::array<std::array<T, N>, 3> q;
    std::array<PlaneVector<T>, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle.corner[i];
      for (std::size_t k = 0; k < N; ++k) q[i][k] = T(state.q[v][k]);
      const Point place = dual_.points()[triangle.place[i]];
      p[i] = {T::variable(place.x, 2 * i), T::variable(place.y, 2 * i + 1)};
    }
    const TriangleShape<T> shape(p, triangle.of_quad, triangle.outlet);
    auto flux = terms_.template triangle<T, N>(q, shape, turbulent_corners(triangle));
    if (N == 5) {
      const T turning = FrictionTerms::template vorticity<T, N>(q, shape);
      for (std::size_t i = 0; i < 3; ++i) {
        const SourceSlope& by = sources[triangle.corner[i]];
        flux[i][N - 1] = flux[i][N - 1] - by.share * shape.share[i] - by.turning * (shape.share[i] * turning);
      }
    }
    for (std::size_t j = 0; j < weights.size(); ++j) {
      std::array<double, 6> by = {};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto part = weighted_slope(weights[j][triangle.corner[i]], flux[i]);
        for (std::size_t z = 0; z < by.size(); ++z) by[z] += part[z];
      }
      for (std::size_t i = 0; i < 3; ++i) {
        Point& at = results[j].points[triangle.place[i]];
        at = at + Point{by[2 * i], by[2 * i + 1]};
      }
    }
  }
  for (std::size_t j = 0; j < weights.size(); ++j)
    mesh_.add_distance_slopes(by_distance[j], results[j].points);
}

template <std::size_t N>
void FrictionSystem<N>::add_boundary_slopes(const BlockState<N>& state, const BlockVector<N>& weight,
                                            FlowMesh::Slopes& slopes, ShapeSlope& result) const {
  using T = Dual<8>;
  for (std::size_t e = 0; e < dual_.boundary().size(); ++e) {
    const BoundaryEdge& edge = dual_.boundary()[e];
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (std::size_t i = 0; i < 2; ++i) {
      BoundaryInputs<T> in = boundary_inputs<T>(state, edge, i);
      std::size_t variable = 0;
      for (PlaneVector<T>* of : {&in.half, &in.normal, &in.place_here, &in.place_there})
        of->x.slope[variable++] = 1.0, of->y.slope[variable++] = 1.0;
      std::array<T, N> here;
      for (std::size_t k = 0; k < N; ++k) here[k] = T(state.q[end[i]][k]);
      const auto by = weighted_slope(
          weight[end[i]], terms_.template boundary_flux<T, N>(dual_.patch(edge), in, here, stream_));
      FlowMesh::Slopes::OfBoundary& of_edge = slopes.boundary[e];
      of_edge.half[i] = {by[0], by[1]};
      of_edge.normal = of_edge.normal + Point{by[2], by[3]};
      for (std::size_t k = 0; k < 2; ++k) {
        Point& place = result.points[edge.place[k == 0 ? i : 1 - i]];
        place = place + Point{by[4 + 2 * k], by[5 + 2 * k]};
      }
    }
  }
}

// Differences of fourth order over a thousandth of each number: to 1e-12 of the residual, where the Mach
// number is in the stream, the viscosity, the flux's factor of slow flow and the rounding of vorticity.
template <std::size_t N>
void FrictionSystem<N>::add_stream_slopes(const BlockState<N>& state, std::span<const BlockVector<N>> weights,
                                          std::span<ShapeSlope> results) const {
  constexpr double part = 1e-3;
  const double reynolds = stream_.mach * stream_.reference_length / terms_.viscosity.stream;
  const auto add = [&](double number, double ShapeSlope::*to, bool of_mach) {
    for (const auto& [step, factor] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      Stream stream = stream_;
      Viscosity viscosity = terms_.viscosity;
      if (of_mach) stream.mach *= 1.0 + step * part;
      viscosity.stream *= of_mach ? 1.0 + step * part : 1.0 / (1.0 + step * part);
      BlockVector<N> flux;
      FrictionSystem(mesh_, stream, viscosity).unbalanced(state, flux);
      for (std::size_t j = 0; j < weights.size(); ++j)
        results[j].*to += factor / (12.0 * part * number) * inner(weights[j], flux);
    }
  };
  add(stream_.mach, &ShapeSlope::mach, true);
  add(reynolds, &ShapeSlope::reynolds, false);
}

template <std::size_t N>
typename FrictionSystem<N>::ForceSlope FrictionSystem<N>::force_slope(const BlockState<N>& state,
                                                                      const WallForces& weight) const {
  BlockVector<N> balance;
  unbalanced(state, balance);
  const WallForces sum = forces(state, balance);
  const double ca = std::cos(state.augmented[1]), sa = std::sin(state.augmented[1]);
  const double scale = 1.0 / (0.5 * stream_.mach * stream_.mach * stream_.length);
  const auto along = [&](double lift, double drag) {
    return Point{scale * (drag * ca - lift * sa), scale * (lift * ca + drag * sa)};
  };
  const Point by_friction = along(weight.lift, weight.drag);
  const Point by_pressure = along(weight.lift, weight.drag + weight.pressure_drag);
  const double by_turning = -scale * weight.moment / stream_.length;
  ForceSlope result;
  result.by_unknowns = zero_of<N>(dual_.size());
  result.shape.points.resize(dual_.size()), result.weight.resize(dual_.size());
  std::vector<Point>& points = result.shape.points;
  FlowMesh::Slopes slopes;
  slopes.boundary.resize(dual_.boundary().size());
  std::vector<bool> of_wall(dual_.size(), false);
  Point pressure_force = {};
  for (std::size_t e = 0; e < dual_.boundary().size(); ++e) {
    const BoundaryEdge& edge = dual_.boundary()[e];
    if (!dual_.patch(edge).solid()) continue;
    of_wall[edge.a] = of_wall[edge.b] = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t here = i == 0 ? edge.a : edge.b, there = i == 0 ? edge.b : edge.a;
      const double p =
          0.75 * (state.q[here][3] - 1.0 / gas_gamma) + 0.25 * (state.q[there][3] - 1.0 / gas_gamma);
      const Point arm = 0.75 * dual_.points()[here] + 0.25 * dual_.points()[there] - stream_.reference;
      const Point by_half = by_pressure + by_turning * Point{-arm.y, arm.x};
      const double by_p = dot(by_half, edge.half[i]);
      result.by_unknowns.q[here][3] += 0.75 * by_p, result.by_unknowns.q[there][3] += 0.25 * by_p;
      slopes.boundary[e].half[i] = p * by_half;
      const Point by_arm = by_turning * p * Point{edge.half[i].y, -edge.half[i].x};
      points[here] = points[here] + 0.75 * by_arm, points[there] = points[there] + 0.25 * by_arm;
      pressure_force = pressure_force + p * edge.half[i];
    }
  }
  dual_.add_slopes(slopes, points);
  const BlockMatrix<N> raw = raw_rows_of_walls(state);
  for (std::size_t r = 0; r < raw.rows.size(); ++r) {
    const std::uint32_t v = raw.rows[r];
    if (!of_wall[v]) continue;
    const Point arm = dual_.points()[v] - stream_.reference, force = friction_force(balance, v);
    const Point by_force = by_friction + by_turning * Point{-arm.y, arm.x};
    points[v] = points[v] + by_turning * Point{force.y, -force.x};
    result.weight[v][1] = -by_force.x, result.weight[v][2] = -by_force.y;
    for (std::uint32_t i = raw.start[r]; i < raw.start[r + 1]; ++i)
      for (std::size_t k = 0; k < N; ++k)
        result.by_unknowns.q[raw.column[i]][k] -=
            by_force.x * raw.block[i][N + k] + by_force.y * raw.block[i][2 * N + k];
  }
  const double pressure_lift = scale * (pressure_force.y * ca - pressure_force.x * sa);
  result.by_unknowns.augmented[1] =
      weight.drag * sum.lift - weight.lift * sum.drag + weight.pressure_drag * pressure_lift;
  result.shape.mach = -2.0 / stream_.mach *
                      (weight.lift * sum.lift + weight.drag * sum.drag + weight.moment * sum.moment +
                       weight.pressure_drag * sum.pressure_drag);
  return result;
}

}  // namespace remodel::flow
