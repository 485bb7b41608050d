// The transposed derivatives of the discretisation by the places of vertices: of metric terms, residuals and
// forces. Reverse by hand across sums, forward dual numbers within one flux.

#include <cmath>

#include "flow/scheme/flow_system.h"

namespace remodel::flow {

namespace {

// An edge vector turned to its outer normal, {d.y, -d.x}, transposed.
Point turned_back(Point by_normal) {
  return {-by_normal.y, by_normal.x};
}

// Of the weighted sum of residuals.
struct Slopes {
  std::vector<Point> normal, weight;           // by dual faces and gradient weights
  std::vector<std::array<Point, 4>> gradient;  // by each vertex's
  double log_length = 0.0;                     // by the logarithm of the limiter's length
};

std::vector<std::array<Point, 4>> gradients_of(const FlowMesh& mesh, const State& state) {
  std::vector<std::array<Point, 4>> gradient(mesh.size(), std::array<Point, 4>{});
  for (std::size_t v = 0; v < mesh.size(); ++v)
    for (const RingEntry& entry : mesh.ring(v))
      for (std::size_t k = 0; k < 4; ++k)
        gradient[v][k] = gradient[v][k] + (state.q[entry.vertex][k] - state.q[v][k]) * entry.weight;
  return gradient;
}

// One side of a face: value = q + direction * step(2 g d - central, central, epsilon), and what linear
// extrapolation is more.
struct FaceSide {
  Unknowns<double> value;
  std::array<double, 4> by_upwind = {}, by_epsilon = {};
  std::array<double, 4> more = {}, more_by_upwind = {}, more_by_epsilon = {};
};

FaceSide reconstruct(const Unknowns<double>& here, const std::array<Point, 4>& gradient, EdgeEnd end, Point d,
                     const std::array<double, 4>& central, double epsilon, double direction) {
  using Two = Dual<2>;
  FaceSide side;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [step, more] =
        reconstruction_step<Two>(end, Two::variable(2.0 * dot(gradient[k], d) - central[k], 0),
                                 Two(central[k]), Two::variable(epsilon, 1));
    side.value[k] = here[k] + direction * step.value, side.more[k] = direction * more.value;
    side.by_upwind[k] = direction * step.slope[0], side.by_epsilon[k] = direction * step.slope[1];
    side.more_by_upwind[k] = direction * more.slope[0], side.more_by_epsilon[k] = direction * more.slope[1];
  }
  for (const std::size_t k : positive) {
    const Bent to = bent(side.value[k], here[k]);
    side.value[k] = to.value;
    side.by_upwind[k] *= to.slope, side.by_epsilon[k] *= to.slope;
  }
  return side;
}

// An inner face with the derivatives of its flux.
struct FaceSlopes {
  std::array<std::uint32_t, 2> source;  // of each side's gradient
  FaceSide side[2];
  std::array<std::array<double, 10>, 4> flux;            // by both sides' values and the normal
  std::array<std::array<double, 4>, 4> by_more[2] = {};  // by what each side has more
  double by_length = 0.0;                                // of epsilon, over the edge's length
};

// Adds the derivatives of the part that linearised fluxes have.
void add_linearised(const Unknowns<double>& qa, const Unknowns<double>& qb, const EdgeEnd (&end)[2],
                    Point normal, FaceSlopes& face) {
  using Ten = Dual<10>;
  const double part = alike<double>(qa, qb);
  for (std::size_t s = 0; s < 2; ++s) {
    const double weight = part * linear_weight(end[s]);
    Unknowns<Ten> value;
    std::array<Ten, 4> more;
    for (std::size_t k = 0; k < 4; ++k) {
      value[k] = Ten::variable(face.side[s].value[k], k);
      more[k] = Ten::variable(face.side[s].more[k], k + 4);
    }
    const std::array<Ten, 4> above = linearised_above<Ten, double, Ten>(
        s == 0 ? qa : qb, value, more, Ten::variable(normal.x, 8), Ten::variable(normal.y, 9));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        face.flux[i][4 * s + k] += weight * above[i].slope[k];
        face.by_more[s][i][k] = weight * above[i].slope[k + 4];
      }
      for (std::size_t k = 8; k < 10; ++k) face.flux[i][k] += weight * above[i].slope[k];
    }
  }
}

FaceSlopes face_slopes(const FlowMesh& mesh, const State& state,
                       const std::vector<std::array<Point, 4>>& gradients, const DualEdge& edge, Point d,
                       double limiter) {
  using Ten = Dual<10>;
  const double length = std::sqrt(dot(d, d)), cube = limiter * limiter * limiter;
  const double epsilon = cube * length * length * length;
  const Unknowns<double>&qa = state.q[edge.a], &qb = state.q[edge.b];
  std::array<double, 4> central;
  for (std::size_t k = 0; k < 4; ++k) central[k] = qb[k] - qa[k];
  const EdgeEnd end[2] = {end_of(mesh, edge.a, edge.b), end_of(mesh, edge.b, edge.a)};
  FaceSlopes face{
      .source = {gradient_source(end[0], edge.a, edge.b), gradient_source(end[1], edge.b, edge.a)},
      .side = {},
      .flux = {},
      .by_more = {},
      .by_length = 3.0 * cube * length};
  face.side[0] = reconstruct(qa, gradients[face.source[0]], end[0], d, central, epsilon, 1.0);
  face.side[1] = reconstruct(qb, gradients[face.source[1]], end[1], d, central, epsilon, -1.0);
  Unknowns<Ten> l, r;
  for (std::size_t k = 0; k < 4; ++k)
    l[k] = Ten::variable(face.side[0].value[k], k), r[k] = Ten::variable(face.side[1].value[k], k + 4);
  const std::array<Ten, 4> flux =
      roe_flux_through<Ten, Ten>(l, r, Ten::variable(edge.normal.x, 8), Ten::variable(edge.normal.y, 9));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 10; ++k) face.flux[i][k] = flux[i].slope[k];
  add_linearised(qa, qb, end, edge.normal, face);
  return face;
}

// Adds the face's part; returns the derivative by the edge's vector.
Point add_face(const FaceSlopes& face, const std::vector<std::array<Point, 4>>& gradients, std::size_t index,
               Point d, const std::array<double, 4>& weight, Slopes& slopes) {
  std::array<double, 10> by = {};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 10; ++k) by[k] += weight[i] * face.flux[i][k];
  slopes.normal[index] = slopes.normal[index] + Point{by[8], by[9]};
  Point by_d = {};
  for (std::size_t s = 0; s < 2; ++s) {
    const std::uint32_t v = face.source[s];
    const FaceSide& side = face.side[s];
    for (std::size_t k = 0; k < 4; ++k) {
      double by_more = 0.0;
      for (std::size_t i = 0; i < 4; ++i) by_more += weight[i] * face.by_more[s][i][k];
      const double by_product = 2.0 * (by[4 * s + k] * side.by_upwind[k] + by_more * side.more_by_upwind[k]);
      slopes.gradient[v][k] = slopes.gradient[v][k] + by_product * d;
      by_d = by_d + by_product * gradients[v][k];
      const double by_length =
          (by[4 * s + k] * side.by_epsilon[k] + by_more * side.more_by_epsilon[k]) * face.by_length;
      by_d = by_d + by_length * d;
      slopes.log_length -= by_length * dot(d, d);  // epsilon has the edge's length over the limiter's
    }
  }
  return by_d;
}

}  // namespace

void FlowMesh::add_half_slopes(std::span<const Point> by_normal, std::span<const Point> by_half,
                               std::vector<Point>& points) const {
  using Eight = Dual<8>;
  for (std::size_t i = 0; i < boundary_.size(); ++i) {
    const BoundaryEdge& edge = boundary_[i];
    Point by_d = turned_back(0.5 * (by_half[2 * i] + by_half[2 * i + 1]));
    if (edge.body >= 0) {
      Point by_turn = by_half[2 * i + 1] - by_half[2 * i];
      if (!by_normal.empty()) {
        const double sign = edge.a == edges_[links_[i].edge].a ? 1.0 : -1.0;
        by_turn = by_turn + sign * by_normal[links_[i].edge];
      }
      const Eight turn = bulge<Eight>(i);
      const double by_bulge = dot(by_turn, points_[edge.b] - points_[edge.a]);
      const std::uint32_t corners[4] = {links_[i].before, edge.a, edge.b, links_[i].after};
      for (std::size_t k = 0; k < 4; ++k)
        if (corners[k] != no_index)
          points[corners[k]] =
              points[corners[k]] + by_bulge * Point{turn.slope[2 * k], turn.slope[2 * k + 1]};
      by_d = by_d + turn.value * by_turn;
    }
    points[edge.a] = points[edge.a] - by_d, points[edge.b] = points[edge.b] + by_d;
  }
}

void FlowMesh::add_slopes(std::span<const Point> by_normal, std::span<const Point> by_weight,
                          std::span<const Point> by_half, std::vector<Point>& points) const {
  add_half_slopes(by_normal, by_half, points);
  std::vector<double> by_around(size(), 0.0);
  std::vector<Point> by_sum(by_weight.begin(), by_weight.end());  // by the sum before it is divided
  for (std::size_t v = 0; v < size(); ++v) {
    const double around = 3.0 * areas_[v];
    for (std::uint32_t i = ring_start_[v]; i < ring_start_[v + 1]; ++i) {
      by_around[v] -= dot(by_weight[i], ring_[i].weight) / around;
      by_sum[i] = (1.0 / around) * by_weight[i];
    }
  }
  const auto entry_of = [&](std::uint32_t v, std::uint32_t edge) {
    std::uint32_t i = ring_start_[v];
    while (ring_[i].edge != edge) ++i;
    return i;
  };
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& corners = triangles_[t];
    const Point p[3] = {points_[corners[0]], points_[corners[1]], points_[corners[2]]};
    const double by_area = by_around[corners[0]] + by_around[corners[1]] + by_around[corners[2]];
    Point by[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      by[i] = by[i] + (0.5 * by_area) * Point{p[j].y - p[k].y, p[k].x - p[j].x};
      const std::uint32_t e = triangle_edges_[t][i];
      const double sign = corners[i] == edges_[e].a ? 1.0 : -1.0;
      const Point by_d = sign * turned_back(by_normal[e]);
      for (Point& corner : by) corner = corner + (1.0 / 3.0) * by_d;
      by[i] = by[i] - 0.5 * by_d, by[j] = by[j] - 0.5 * by_d;
      // weights are half of {-side.y, side.x}
      const Point at_i = by_sum[entry_of(corners[i], e)], at_j = by_sum[entry_of(corners[j], e)];
      const Point by_side_j = {0.5 * at_i.y, -0.5 * at_i.x}, by_side_i = {0.5 * at_j.y, -0.5 * at_j.x};
      by[i] = by[i] + by_side_j, by[k] = by[k] - by_side_j;
      by[k] = by[k] + by_side_i, by[j] = by[j] - by_side_i;
    }
    for (std::size_t i = 0; i < 3; ++i) points[corners[i]] = points[corners[i]] + by[i];
  }
}

std::vector<ShapeSlope> FlowSystem::residual_slopes(
    const State& state, std::span<const std::vector<std::array<double, 4>>> weights) const {
  const std::size_t n = mesh_.size(), edges = mesh_.edges().size();
  const std::vector<std::array<Point, 4>> gradients = gradients_of(mesh_, state);
  std::vector<ShapeSlope> results(weights.size(), {.points = std::vector<Point>(n)});
  std::vector<Slopes> slopes(weights.size(),
                             {.normal = std::vector<Point>(edges),
                              .weight = std::vector<Point>(2 * edges),
                              .gradient = std::vector<std::array<Point, 4>>(n, std::array<Point, 4>{})});
  for (std::size_t e = 0; e < edges; ++e) {
    const DualEdge& edge = mesh_.edges()[e];
    const Point d = mesh_.points()[edge.b] - mesh_.points()[edge.a];
    const FaceSlopes face = face_slopes(mesh_, state, gradients, edge, d, stream_.limiter / stream_.length);
    for (std::size_t j = 0; j < weights.size(); ++j) {
      std::array<double, 4> w;
      for (std::size_t k = 0; k < 4; ++k) w[k] = weights[j][edge.a][k] - weights[j][edge.b][k];
      const Point by_d = add_face(face, gradients, e, d, w, slopes[j]);
      std::vector<Point>& points = results[j].points;
      points[edge.a] = points[edge.a] - by_d, points[edge.b] = points[edge.b] + by_d;
    }
  }
  for (std::size_t j = 0; j < weights.size(); ++j) {
    for (std::size_t v = 0; v < n; ++v) {
      std::size_t i = mesh_.ring_begin(v);
      for (const RingEntry& entry : mesh_.ring(v)) {
        for (std::size_t k = 0; k < 4; ++k)
          slopes[j].weight[i] =
              slopes[j].weight[i] + (state.q[entry.vertex][k] - state.q[v][k]) * slopes[j].gradient[v][k];
        ++i;
      }
    }
    results[j].length = slopes[j].log_length / stream_.length;
    const std::vector<Point> by_half = add_boundary_slopes(state, weights[j], results[j]);
    mesh_.add_slopes(slopes[j].normal, slopes[j].weight, by_half, results[j].points);
  }
  return results;
}

namespace {

// Adds to the derivatives by both halves of a wall's edge those of wall_force() of its half i.
void add_wall_force(Point by_force, std::size_t i, double here, double there, Point* by_half) {
  by_half[i] = by_half[i] + (near_place * here + far_place * there) * by_force;
  const Point by_normal = ((near_weight - near_place) * 0.5 * (here - there)) * by_force;
  by_half[0] = by_half[0] + by_normal, by_half[1] = by_half[1] + by_normal;  // halves' sum is the normal
}

}  // namespace

// Of fluxes through the boundary; returns the derivatives by halves of its edges.
std::vector<Point> FlowSystem::add_boundary_slopes(const State& state,
                                                   const std::vector<std::array<double, 4>>& weight,
                                                   ShapeSlope& result) const {
  using Five = Dual<5>;
  const double strength = stream_.vortex ? state.augmented[0] * stream_.length : 0.0;
  std::vector<Point> by_half(2 * mesh_.boundary().size());
  for (std::size_t e = 0; e < mesh_.boundary().size(); ++e) {
    const BoundaryEdge& edge = mesh_.boundary()[e];
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (std::size_t i = 0; i < 2; ++i) {
      const Point half = edge.half[i];
      const std::uint32_t here = end[i], there = end[1 - i];
      const Unknowns<double> q = weighted(state.q[here], state.q[there]);
      const std::array<double, 4>& w = weight[here];
      if (edge.body >= 0) {
        add_wall_force({w[1], w[2]}, i, state.q[here][3], state.q[there][3], &by_half[2 * e]);
        continue;
      }
      if (stream_.prescribed) continue;
      const Point p =
          near_weight * mesh_.points()[here] + far_weight * mesh_.points()[there] - stream_.reference;
      const Unknowns<Five> outside = stream_around<Five, Five, Five>(
          Five::variable(p.x, 2), Five::variable(p.y, 3), Five::variable(stream_.mach, 4),
          Five(state.augmented[1]), Five(strength));
      const Unknowns<Five> inside = {Five(q[0]), Five(q[1]), Five(q[2]), Five(q[3])};
      const std::array<Five, 4> flux =
          roe_flux_through<Five, Five>(inside, outside, Five::variable(half.x, 0), Five::variable(half.y, 1));
      std::array<double, 5> by = {};
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 5; ++k) by[k] += w[j] * flux[j].slope[k];
      by_half[2 * e + i] = {by[0], by[1]};
      result.points[here] = result.points[here] + near_weight * Point{by[2], by[3]};
      result.points[there] = result.points[there] + far_weight * Point{by[2], by[3]};
      result.mach += by[4];
    }
  }
  return by_half;
}

ForceSlope FlowSystem::force_slope(const State& state, const Coefficients& weight) const {
  ForceSlope result;
  result.shape.points.assign(mesh_.size(), {});
  result.pressure.assign(mesh_.size(), 0.0);
  const Coefficients sum = coefficients(state);
  result.alpha = weight.drag * sum.lift - weight.lift * sum.drag;
  result.shape.mach =
      -2.0 / stream_.mach * (weight.lift * sum.lift + weight.drag * sum.drag + weight.moment * sum.moment);
  const double scale = 1.0 / (0.5 * stream_.mach * stream_.mach * stream_.length);
  const double ca = std::cos(state.augmented[1]), sa = std::sin(state.augmented[1]);
  const Point by_force =
      scale * Point{weight.drag * ca - weight.lift * sa, weight.drag * sa + weight.lift * ca};
  const double by_turning = -scale * weight.moment / stream_.length;
  std::vector<Point> by_half(2 * mesh_.boundary().size());
  for (std::size_t e = 0; e < mesh_.boundary().size(); ++e) {
    const BoundaryEdge& edge = mesh_.boundary()[e];
    if (edge.body < 0) continue;
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t here = end[i], there = end[1 - i];
      const double p_here = state.q[here][3] - 1.0 / gas_gamma, p_there = state.q[there][3] - 1.0 / gas_gamma;
      const Point f = wall_force(edge, i, p_here, p_there);
      const Point arm =
          near_place * mesh_.points()[here] + far_place * mesh_.points()[there] - stream_.reference;
      const Point by_f = by_force + by_turning * Point{-arm.y, arm.x};
      const Point by_arm = by_turning * Point{f.y, -f.x};
      const std::array<Point, 2> by_pressure = wall_force_slopes(edge, i);
      result.pressure[here] += dot(by_f, by_pressure[0]);
      result.pressure[there] += dot(by_f, by_pressure[1]);
      std::vector<Point>& points = result.shape.points;
      add_wall_force(by_f, i, p_here, p_there, &by_half[2 * e]);
      points[here] = points[here] + near_place * by_arm;
      points[there] = points[there] + far_place * by_arm;
    }
  }
  mesh_.add_half_slopes({}, by_half, result.shape.points);
  return result;
}

}  // namespace remodel::flow
