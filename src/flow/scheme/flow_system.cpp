#include "flow/scheme/flow_system.h"

#include <algorithm>

namespace remodel::flow {

// What both ends of an edge see of the face between them.
struct FlowSystem::Face {
  Unknowns<double> left, right;
  // Derivatives of the reconstructed values by both differences, left then right: the upwind one, the central
  // one.
  std::array<double, 4> by_upwind[2] = {{}, {}}, by_central[2] = {{}, {}};
  std::array<double, 4> by_own[2] = {{1, 1, 1, 1}, {1, 1, 1, 1}};  // by the vertex's own value
  // What linear extrapolation is more, with the same derivatives, and the weights of linearised fluxes.
  std::array<double, 4> more[2] = {{}, {}}, more_by_upwind[2] = {{}, {}}, more_by_central[2] = {{}, {}};
  double linear[2];
  std::uint32_t source[2];  // whose gradient the upwind difference is of
};

// The derivatives of the flux from a to b: by the products of an edge's vector with the gradients of both
// sides' sources, by the difference of b's value and a's, and by both values directly.
struct FlowSystem::Linear {
  Block by_product[2], by_difference, by_own[2];
  std::uint32_t source[2];
};

State FlowSystem::uniform() const {
  State state;
  state.augmented = {0.0, stream_.alpha};
  state.q.assign(mesh_.size(), stream_at<double>({0, 0}, stream_.mach, stream_.alpha, 0.0));
  return state;
}

double FlowSystem::epsilon(Point d) const {
  const double h = stream_.limiter * std::sqrt(dot(d, d)) / stream_.length;
  return h * h * h;
}

// The gradient at a vertex times d.
std::array<double, 4> FlowSystem::difference(const State& state, std::size_t vertex, Point d) const {
  std::array<double, 4> sum = {};
  const Unknowns<double>& here = state.q[vertex];
  for (const RingEntry& entry : mesh_.ring(vertex)) {
    const double w = dot(entry.weight, d);
    const Unknowns<double>& there = state.q[entry.vertex];
    for (std::size_t k = 0; k < 4; ++k) sum[k] += w * (there[k] - here[k]);
  }
  return sum;
}

FlowSystem::Face FlowSystem::face(const State& state, const DualEdge& edge) const {
  using Two = Dual<2>;
  Face face;
  const Point d = mesh_.points()[edge.b] - mesh_.points()[edge.a];
  const double eps = epsilon(d);
  const Unknowns<double>&qa = state.q[edge.a], &qb = state.q[edge.b];
  const EdgeEnd end[2] = {end_of(mesh_, edge.a, edge.b), end_of(mesh_, edge.b, edge.a)};
  face.source[0] = gradient_source(end[0], edge.a, edge.b);
  face.source[1] = gradient_source(end[1], edge.b, edge.a);
  face.linear[0] = linear_weight(end[0]), face.linear[1] = linear_weight(end[1]);
  const std::array<double, 4> da = difference(state, face.source[0], d);
  const std::array<double, 4> db =
      face.source[0] == face.source[1] ? da : difference(state, face.source[1], d);
  for (std::size_t k = 0; k < 4; ++k) {
    const double central = qb[k] - qa[k];
    const std::array<double, 4>* products[2] = {&da, &db};
    for (std::size_t side = 0; side < 2; ++side) {
      const double direction = side == 0 ? stream_.slopes : -stream_.slopes;
      const Step<Two> to = reconstruction_step(
          end[side], Two::variable(2.0 * (*products[side])[k] - central, 0), Two::variable(central, 1), eps);
      (side == 0 ? face.left : face.right)[k] = (side == 0 ? qa : qb)[k] + direction * to.step.value;
      face.more[side][k] = direction * to.more.value;
      face.by_upwind[side][k] = stream_.slopes * to.step.slope[0];
      face.by_central[side][k] = stream_.slopes * to.step.slope[1];
      face.more_by_upwind[side][k] = stream_.slopes * to.more.slope[0];
      face.more_by_central[side][k] = stream_.slopes * to.more.slope[1];
    }
  }
  for (const std::size_t k : positive) {
    const Bent to[2] = {bent(face.left[k], qa[k]), bent(face.right[k], qb[k])};
    face.left[k] = to[0].value, face.right[k] = to[1].value;
    for (std::size_t side = 0; side < 2; ++side) {
      face.by_upwind[side][k] *= to[side].slope, face.by_central[side][k] *= to[side].slope;
      face.by_own[side][k] = to[side].own;
    }
  }
  return face;
}

Unknowns<double> FlowSystem::far_state(const State& state, Point p) const {
  if (stream_.prescribed) return stream_.prescribed(p);
  return stream_at<double>(p - stream_.reference, stream_.mach, state.augmented[1],
                           stream_.vortex ? state.augmented[0] * stream_.length : 0.0);
}

template <class T>
std::array<T, 4> FlowSystem::open_flux(const BoundaryEdge& edge, const Unknowns<T>& inside,
                                       const State& state, Point p) const {
  const Point half = edge.half[0];  // both are the same where there is no wall
  if (edge.body == -1) {
    const Unknowns<double> far = far_state(state, p);
    return roe_flux<T>(inside, {T(far[0]), T(far[1]), T(far[2]), T(far[3])}, half);
  }
  const Opening& opening = stream_.openings[static_cast<std::size_t>(-2 - edge.body)];
  const Unknowns<T> at = opening.is_inlet
                             ? inlet_state(inside, half, opening.total_pressure, opening.total_sound_square)
                             : outlet_state(inside, half, opening.pressure);
  return roe_flux<T>(at, at, half);  // of one state: its own flux
}

std::vector<double> FlowSystem::mass_flows(const State& state) const {
  std::vector<double> flows(stream_.openings.size(), 0.0);
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    if (edge.body >= -1) continue;
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (int i = 0; i < 2; ++i) {
      const Unknowns<double> q = weighted(state.q[end[i]], state.q[end[1 - i]]);
      flows[static_cast<std::size_t>(-2 - edge.body)] -= open_flux<double>(edge, q, state, {})[0];
    }
  }
  return flows;
}

void FlowSystem::residual(const State& state, std::vector<std::array<double, 4>>& out) const {
  const std::size_t n = mesh_.size();
  out.assign(n, {});
  // Gradients once a vertex, not twice an edge as face() has them.
  std::vector<std::array<Point, 4>> gradient(n);
  for (std::size_t v = 0; v < n; ++v) {
    std::array<Point, 4> sum = {};
    for (const RingEntry& entry : mesh_.ring(v))
      for (std::size_t k = 0; k < 4; ++k) {
        const double step = state.q[entry.vertex][k] - state.q[v][k];
        sum[k].x += entry.weight.x * step;
        sum[k].y += entry.weight.y * step;
      }
    gradient[v] = sum;
  }
  for (const DualEdge& edge : mesh_.edges()) {
    const Point d = mesh_.points()[edge.b] - mesh_.points()[edge.a];
    const double eps = epsilon(d);
    const Unknowns<double>&qa = state.q[edge.a], &qb = state.q[edge.b];
    const EdgeEnd end_a = end_of(mesh_, edge.a, edge.b), end_b = end_of(mesh_, edge.b, edge.a);
    const auto& gradient_a = gradient[gradient_source(end_a, edge.a, edge.b)];
    const auto& gradient_b = gradient[gradient_source(end_b, edge.b, edge.a)];
    Unknowns<double> left, right;
    std::array<double, 4> more_left, more_right;
    for (std::size_t k = 0; k < 4; ++k) {
      const double central = qb[k] - qa[k];
      const Step<double> a =
          reconstruction_step<double>(end_a, 2.0 * dot(gradient_a[k], d) - central, central, eps);
      const Step<double> b =
          reconstruction_step<double>(end_b, 2.0 * dot(gradient_b[k], d) - central, central, eps);
      left[k] = qa[k] + stream_.slopes * a.step, more_left[k] = stream_.slopes * a.more;
      right[k] = qb[k] - stream_.slopes * b.step, more_right[k] = -stream_.slopes * b.more;
    }
    for (const std::size_t k : positive)
      left[k] = bent(left[k], qa[k]).value, right[k] = bent(right[k], qb[k]).value;
    std::array<double, 4> flux = roe_flux<double>(left, right, edge.normal);
    const std::array<double, 4> above_a =
        linearised_above<double, double, double>(qa, left, more_left, edge.normal.x, edge.normal.y);
    const std::array<double, 4> above_b =
        linearised_above<double, double, double>(qb, right, more_right, edge.normal.x, edge.normal.y);
    const double part = alike<double>(qa, qb);
    for (std::size_t k = 0; k < 4; ++k)
      flux[k] += part * (linear_weight(end_a) * above_a[k] + linear_weight(end_b) * above_b[k]);
    for (std::size_t k = 0; k < 4; ++k) out[edge.a][k] += flux[k], out[edge.b][k] -= flux[k];
  }
  add_boundary(state, out);
  for (std::size_t v = 0; v < stream_.source.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) out[v][k] -= stream_.source[v][k];
}

void FlowSystem::add_boundary(const State& state, std::vector<std::array<double, 4>>& out) const {
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (int i = 0; i < 2; ++i) {
      const std::uint32_t here = end[i], there = end[1 - i];
      if (edge.body >= 0) {
        const Point force =
            wall_force(edge, static_cast<std::size_t>(i), state.q[here][3], state.q[there][3]);
        out[here][1] += force.x, out[here][2] += force.y;
        continue;
      }
      const Unknowns<double> q = weighted(state.q[here], state.q[there]);
      const Point p = near_weight * mesh_.points()[here] + far_weight * mesh_.points()[there];
      const std::array<double, 4> flux = open_flux<double>(edge, q, state, p);
      for (std::size_t k = 0; k < 4; ++k) out[here][k] += flux[k];
    }
  }
}

BlockRows FlowSystem::pattern() const {
  std::vector<std::uint32_t> all(mesh_.size());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  return pattern(std::move(all));
}

BlockRows FlowSystem::pattern(std::vector<std::uint32_t> rows) const {
  BlockRows matrix;
  matrix.rows = std::move(rows);
  matrix.start.assign(1, 0);
  std::vector<std::uint32_t> seen(mesh_.size(), 0), columns;
  for (std::uint32_t r = 0; r < matrix.rows.size(); ++r) {
    columns.clear();
    const auto note = [&](std::uint32_t v) {
      if (seen[v] == r + 1) return;
      seen[v] = r + 1;
      columns.push_back(v);
    };
    note(matrix.rows[r]);
    for (const RingEntry& first : mesh_.ring(matrix.rows[r])) {
      note(first.vertex);
      for (const RingEntry& second : mesh_.ring(first.vertex)) note(second.vertex);
    }
    std::sort(columns.begin(), columns.end());
    matrix.column.insert(matrix.column.end(), columns.begin(), columns.end());
    matrix.start.push_back(static_cast<std::uint32_t>(matrix.column.size()));
  }
  matrix.block.resize(matrix.column.size());
  return matrix;
}

FlowSystem::Linear FlowSystem::linearised(const Face& face, const Unknowns<double>& qa,
                                          const Unknowns<double>& qb, Point normal) {
  using Eight = Dual<8>;
  using One = Dual<1>;
  Block by[2], by_more[2] = {{}, {}};  // by the states on both sides, by what linear extrapolation is more
  Linear made{
      .by_product = {}, .by_difference = {}, .by_own = {}, .source = {face.source[0], face.source[1]}};
  Unknowns<Eight> l, r, a, b;
  for (std::size_t k = 0; k < 4; ++k) {
    l[k] = Eight::variable(face.left[k], k), r[k] = Eight::variable(face.right[k], k + 4);
    a[k] = Eight::variable(qa[k], k), b[k] = Eight::variable(qb[k], k + 4);
  }
  const std::array<Eight, 4> flux = roe_flux<Eight>(l, r, normal);
  const Eight part = alike<Eight>(a, b);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      by[0][4 * i + k] = flux[i].slope[k], by[1][4 * i + k] = flux[i].slope[k + 4];
  for (std::size_t side = 0; side < 2; ++side) {
    if (face.linear[side] == 0.0) continue;
    const Unknowns<double>&vertex = side == 0 ? qa : qb, &value = side == 0 ? face.left : face.right;
    const std::array<double, 4> above =
        linearised_above<double, double, double>(vertex, value, face.more[side], normal.x, normal.y);
    Unknowns<One> along;  // the whole step that the flux is linear in
    for (std::size_t k = 0; k < 4; ++k) {
      along[k].value = vertex[k];
      along[k].slope[0] = value[k] - vertex[k] + face.more[side][k];
    }
    const std::array<One, 16> at_vertex = flux_slopes<One>(along, normal);
    const std::array<double, 16> at_value = flux_slopes<double>(value, normal);
    const double weight = face.linear[side] * part.value;
    for (std::size_t z = 0; z < 16; ++z) {
      made.by_own[side][z] += weight * at_vertex[z].slope[0];
      by[side][z] += weight * (at_vertex[z].value - at_value[z]);
      by_more[side][z] = weight * at_vertex[z].value;
      for (std::size_t end = 0; end < 2; ++end)
        made.by_own[end][z] += face.linear[side] * above[z / 4] * part.slope[z % 4 + 4 * end];
    }
  }
  // value = q(end) +- step(2 g d - (qb - qa), qb - qa), where nothing bends it; what is more likewise
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t z = 0; z < 16; ++z) {
      const std::size_t k = z % 4;
      const double direction = side == 0 ? 1.0 : -1.0;
      const double up =
          by[side][z] * face.by_upwind[side][k] + by_more[side][z] * face.more_by_upwind[side][k];
      const double central =
          by[side][z] * face.by_central[side][k] + by_more[side][z] * face.more_by_central[side][k];
      made.by_product[side][z] = 2.0 * direction * up;
      made.by_difference[z] += direction * (central - up);
      made.by_own[side][z] += by[side][z] * face.by_own[side][k];
    }
  return made;
}

// A row's flux depends, by the chain rule, on what is reconstructed at both ends of each of its edges, and
// this on the rings of both ends.
void FlowSystem::jacobian(const State& state, BlockRows& matrix) const {
  std::fill(matrix.block.begin(), matrix.block.end(), Block{});
  std::vector<Linear> fluxes;
  if (matrix.rows.size() == mesh_.size()) fluxes.reserve(mesh_.edges().size());
  std::vector<std::uint32_t> flux_of(mesh_.edges().size(), no_index);
  const auto linear = [&](std::uint32_t e) -> const Linear& {
    if (flux_of[e] != no_index) return fluxes[flux_of[e]];
    flux_of[e] = static_cast<std::uint32_t>(fluxes.size());
    const DualEdge& edge = mesh_.edges()[e];
    return fluxes.emplace_back(linearised(face(state, edge), state.q[edge.a], state.q[edge.b], edge.normal));
  };

  std::vector<std::uint32_t> place(mesh_.size()), row_of(mesh_.size(), no_index);
  for (std::uint32_t r = 0; r < matrix.rows.size(); ++r) {
    const std::uint32_t here = matrix.rows[r];
    row_of[here] = r;
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i) place[matrix.column[i]] = i;
    for (const RingEntry& entry : mesh_.ring(here)) {
      const Linear& flux = linear(entry.edge);
      const DualEdge& edge = mesh_.edges()[entry.edge];
      const double sign = here == edge.a ? 1.0 : -1.0;
      const Point d = mesh_.points()[edge.b] - mesh_.points()[edge.a];
      Block &at_a = matrix.block[place[edge.a]], &at_b = matrix.block[place[edge.b]];
      for (std::size_t z = 0; z < 16; ++z) {
        at_a[z] += sign * (flux.by_own[0][z] - flux.by_difference[z]);
        at_b[z] += sign * (flux.by_own[1][z] + flux.by_difference[z]);
      }
      for (std::size_t side = 0; side < 2; ++side) {
        const Block& by = flux.by_product[side];
        double total = 0.0;
        for (const RingEntry& around : mesh_.ring(flux.source[side])) {
          const double w = sign * dot(around.weight, d);
          total += w;
          Block& at = matrix.block[place[around.vertex]];
          for (std::size_t z = 0; z < 16; ++z) at[z] += w * by[z];
        }
        Block& at_source = matrix.block[place[flux.source[side]]];
        for (std::size_t z = 0; z < 16; ++z) at_source[z] -= total * by[z];
      }
    }
  }
  add_boundary_blocks(state, matrix, row_of);
}

void FlowSystem::add_boundary_blocks(const State& state, BlockRows& matrix,
                                     std::span<const std::uint32_t> row_of) const {
  using Four = Dual<4>;
  const auto at = [&](std::uint32_t row, std::uint32_t column) -> Block& {
    const auto first = matrix.column.begin() + matrix.start[row],
               last = matrix.column.begin() + matrix.start[row + 1];
    return matrix
        .block[static_cast<std::size_t>(std::lower_bound(first, last, column) - matrix.column.begin())];
  };
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (int i = 0; i < 2; ++i) {
      const std::uint32_t here = end[i], there = end[1 - i];
      if (row_of[here] == no_index) continue;
      Block &own = at(row_of[here], here), &other = at(row_of[here], there);
      if (edge.body >= 0) {
        const auto [by_own, by_other] = wall_force_slopes(edge, static_cast<std::size_t>(i));
        own[7] += by_own.x, own[11] += by_own.y;
        other[7] += by_other.x, other[11] += by_other.y;
        continue;
      }
      const Unknowns<double> q = weighted(state.q[here], state.q[there]);
      const Point p = near_weight * mesh_.points()[here] + far_weight * mesh_.points()[there];
      Unknowns<Four> l;
      for (std::size_t k = 0; k < 4; ++k) l[k] = Four::variable(q[k], k);
      const std::array<Four, 4> flux = open_flux<Four>(edge, l, state, p);
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k) {
          own[4 * j + k] += near_weight * flux[j].slope[k];
          other[4 * j + k] += far_weight * flux[j].slope[k];
        }
    }
  }
}

std::array<std::vector<std::array<double, 4>>, 2> FlowSystem::augmented_columns(const State& state) const {
  using Two = Dual<2>;
  std::array<std::vector<std::array<double, 4>>, 2> columns;
  for (auto& column : columns) column.assign(mesh_.size(), {});
  if (stream_.prescribed) return columns;
  const Two lift = stream_.vortex ? Two::variable(state.augmented[0], 0) * stream_.length : Two(0.0);
  const Two alpha = Two::variable(state.augmented[1], 1);
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    if (edge.body != -1) continue;
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (int i = 0; i < 2; ++i) {
      const std::uint32_t here = end[i], there = end[1 - i];
      const Unknowns<double> q = weighted(state.q[here], state.q[there]);
      const Point p = near_weight * mesh_.points()[here] + far_weight * mesh_.points()[there];
      const Unknowns<Two> inside = {Two(q[0]), Two(q[1]), Two(q[2]), Two(q[3])};
      const std::array<Two, 4> flux = roe_flux<Two>(
          inside, stream_at<Two>(p - stream_.reference, stream_.mach, alpha, lift), 0.5 * edge.normal);
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t z = 0; z < 2; ++z) columns[z][here][k] += flux[k].slope[z];
    }
  }
  return columns;
}

// visit(edge, i, here, there): half i of the edge, at `here`.
template <class Visit>
void FlowSystem::for_each_wall_half(Visit visit) const {
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    if (edge.body < 0) continue;
    visit(edge, 0, edge.a, edge.b);
    visit(edge, 1, edge.b, edge.a);
  }
}

Coefficients FlowSystem::coefficients(const State& state) const {
  return coefficients(state, -1);
}

Coefficients FlowSystem::coefficients(const State& state, std::int32_t body) const {
  Point force = {};
  double turning = 0.0;  // counter-clockwise
  const double outside = 1.0 / gas_gamma;
  for_each_wall_half([&](const BoundaryEdge& edge, std::size_t i, std::uint32_t here, std::uint32_t there) {
    if (body >= 0 && edge.body != body) return;
    const Point f = wall_force(edge, i, state.q[here][3] - outside, state.q[there][3] - outside);
    const Point at = near_place * mesh_.points()[here] + far_place * mesh_.points()[there];
    force = force + f;
    turning += cross(at - stream_.reference, f);
  });
  const double scale = 1.0 / (0.5 * stream_.mach * stream_.mach * stream_.length);
  const double ca = std::cos(state.augmented[1]), sa = std::sin(state.augmented[1]);
  return {.lift = scale * (force.y * ca - force.x * sa),
          .drag = scale * (force.x * ca + force.y * sa),
          .moment = -scale * turning / stream_.length};
}

std::array<double, 2> FlowSystem::augmented_residual(const State& state) const {
  const Coefficients sum = coefficients(state);
  return {sum.lift - state.augmented[0],
          stream_.lift ? state.augmented[0] - *stream_.lift : state.augmented[1] - stream_.alpha};
}

FlowSystem::AugmentedRows FlowSystem::augmented_rows(const State& state) const {
  AugmentedRows rows;
  const double scale = 1.0 / (0.5 * stream_.mach * stream_.mach * stream_.length);
  const double ca = std::cos(state.augmented[1]), sa = std::sin(state.augmented[1]);
  for_each_wall_half([&](const BoundaryEdge& edge, std::size_t i, std::uint32_t here, std::uint32_t there) {
    const auto [by_own, by_other] = wall_force_slopes(edge, i);
    rows.lift.push_back({here, scale * (by_own.y * ca - by_own.x * sa)});
    rows.lift.push_back({there, scale * (by_other.y * ca - by_other.x * sa)});
  });
  rows.corner[0] = {-1.0, -coefficients(state).drag};
  rows.corner[1] = stream_.lift ? std::array{1.0, 0.0} : std::array{0.0, 1.0};
  return rows;
}

std::vector<double> FlowSystem::wave_speeds(const State& state) const {
  std::vector<double> sum(mesh_.size(), 0.0);
  const auto speed = [&](std::uint32_t v, Point normal) {
    const Unknowns<double>& q = state.q[v];
    return std::fabs(q[1] * normal.x + q[2] * normal.y) +
           std::sqrt(gas_gamma * q[3] / q[0] * dot(normal, normal));
  };
  for (const DualEdge& edge : mesh_.edges()) {
    sum[edge.a] += 0.5 * speed(edge.a, edge.normal);
    sum[edge.b] += 0.5 * speed(edge.b, edge.normal);
  }
  for (const BoundaryEdge& edge : mesh_.boundary()) {
    sum[edge.a] += 0.25 * speed(edge.a, edge.normal);
    sum[edge.b] += 0.25 * speed(edge.b, edge.normal);
  }
  return sum;
}

}  // namespace remodel::flow
