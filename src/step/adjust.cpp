#include "step/adjust.h"

#include <algorithm>
#include <cmath>

#include "remodel/predicates.h"
#include "step/lanes.h"

namespace remodel {

namespace {

using Moving = AdjustCache::Moving;
using Affected = AdjustCache::Affected;

Moving moving_vertex(const MeshData& mesh, AdjustCache& cache, std::uint32_t k) {
  const BoundaryVertex& from = mesh.at(k);
  Moving moving{};
  moving.boundary = k;
  moving.vertex = from.vertex;
  moving.curve = from.curve;
  if (const auto* airfoil = std::get_if<CstAirfoil>(&mesh.curve(from.curve).shape)) {
    moving.row = cache.basis.size();
    moving.basis_size = airfoil->upper.size();
    cache.basis.resize(moving.row + moving.basis_size);
    moving.station = cst_basis(from.t, airfoil->degree(), airfoil->e1, airfoil->e2,
                               {cache.basis.data() + moving.row, moving.basis_size});
  }
  return moving;
}

// Lists the moving vertices. Of non-Steiner ones that the cache knows from before only the ids may have
// changed: their rows depend on the design's parameters alone.
void list_moving(MeshData& mesh, AdjustCache& cache) {
  const std::size_t known = cache.non_steiner;
  cache.moving.resize(known);
  cache.basis.resize(cache.non_steiner_basis);
  List<std::uint32_t> steiner(&mesh.arena);
  std::size_t n = 0;
  for (const std::size_t loop : cache.loops)
    mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) {
      const BoundaryVertex& vertex = mesh.at(k);
      if (vertex.steiner) {
        steiner.push_back(k);
        return;
      }
      if (n < known) {
        cache.moving[n].boundary = k;
        cache.moving[n].vertex = vertex.vertex;
      } else {
        cache.moving.push_back(moving_vertex(mesh, cache, k));
      }
      ++n;
    });
  const std::size_t basis = cache.basis.size();
  for (const std::uint32_t k : steiner) cache.moving.push_back(moving_vertex(mesh, cache, k));

  cache.positions.resize(mesh.boundary.size());
  for (std::uint32_t i = 0; i < n; ++i) cache.positions[cache.moving[i].boundary] = i;
  for (std::size_t i = known; i < cache.moving.size(); ++i) {
    Moving& m = cache.moving[i];
    std::uint32_t before = mesh.non_steiner_before(m.boundary), after = mesh.non_steiner_after(m.boundary);
    if (before == no_index) before = after;
    if (after == no_index) after = before;
    m.before = cache.positions[before == no_index ? m.boundary : before];
    m.after = cache.positions[after == no_index ? m.boundary : after];
  }
  cache.non_steiner = n;
  cache.non_steiner_basis = basis;
}

// Affected triangles, each once, and the star lists.
void list_affected(MeshData& mesh, AdjustCache& cache) {
  const Triangulation& triangulation = mesh.triangulation;
  mesh.affected_indices.clear(triangulation.triangle_slots());
  for (Moving& m : cache.moving) {
    m.star_begin = cache.stars.size();
    triangulation.for_each_corner(m.vertex, [&](Corner c) {
      const Triangle& triangle = triangulation[c.triangle];
      if (triangle.ghost()) return;
      const auto next = static_cast<std::uint32_t>(cache.affected.size());
      if (mesh.affected_indices.insert(c.triangle, next)) {
        const bool domain = triangle.region == Region::domain;
        if (domain) cache.in_domain.push_back(next);
        cache.affected.push_back({.triangle = c.triangle,
                                  .vertex = {triangle.vertex[0], triangle.vertex[1], triangle.vertex[2]},
                                  .circle = {},
                                  .domain = domain});
      }
      const std::uint32_t index = mesh.affected_indices[c.triangle];
      cache.stars.push_back(index);
      ++cache.affected[index].movable;
    });
    m.star_end = cache.stars.size();
  }
}

void list_edges(MeshData& mesh, AdjustCache& cache) {
  const Triangulation& triangulation = mesh.triangulation;
  for (std::uint32_t i = 0; i < cache.affected.size(); ++i) {
    if (!cache.affected[i].domain) continue;
    const Triangle& triangle = triangulation[cache.affected[i].triangle];
    for (int k = 0; k < 3; ++k) {
      const Link link = triangle.link[k];
      if (link.constrained()) {
        cache.segments.push_back(
            {i, triangle.vertex[next3(k)], triangle.vertex[previous3(k)], triangle.vertex[k]});
        continue;
      }
      const std::uint32_t across = mesh.affected_indices.value_or(link.triangle(), no_index);
      if (across < i) continue;  // tested from the other side
      cache.edges.push_back({i, across, triangulation.apex(link)});
    }
  }
}

void place(const MeshData& mesh, AdjustCache& cache, const Domain& domain) {
  const std::size_t n = cache.moving.size();
  cache.old_points.resize(n);
  cache.new_points.resize(n);
  const Curve* curve = nullptr;         // of number present
  const CstAirfoil* airfoil = nullptr;  // the curve's, if the cached basis is its
  std::uint32_t present = no_index;
  Frame frame({});
  for (std::size_t i = 0; i < n; ++i) {
    const Moving& m = cache.moving[i];
    cache.old_points[i] = mesh.triangulation.point(m.vertex);
    if (m.curve != present) {
      present = m.curve;
      curve = &domain.curve(present);
      frame = Frame(domain.loops[mesh.loop_of(present)].placement);
      airfoil = std::get_if<CstAirfoil>(&curve->shape);
      if (airfoil != nullptr && !same_basis(*airfoil, std::get<CstAirfoil>(mesh.curve(present).shape)))
        airfoil = nullptr;
    }
    const Point p =
        airfoil == nullptr
            ? point_at(curve->shape, mesh.at(m.boundary).t)
            : Point{m.station.x, cst_height(*airfoil, m.station, {cache.basis.data() + m.row, m.basis_size})};
    cache.new_points[i] = frame(p);
  }
}

void copy_shapes(AdjustCache& cache, const Domain& domain) {
  std::size_t n = 0;
  cache.placements.clear();
  for (const std::size_t loop : cache.loops) {
    cache.placements.push_back(domain.loops[loop].placement);
    for (const Curve& curve : domain.loops[loop].curves) {
      if (n == cache.shapes.size()) cache.shapes.emplace_back();
      cache.shapes[n++] = curve.shape;
    }
  }
}

// Length scales at the new positions, by the rule of MeshData::base_length_scale.
void scale(const MeshData& mesh, AdjustCache& cache) {
  const std::size_t n = cache.moving.size();
  cache.old_scales.resize(n);
  cache.new_scales.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Moving& m = cache.moving[i];
    cache.old_scales[i] = mesh.triangulation[m.vertex].length_scale;
    const double to_before = std::sqrt(squared_distance(cache.new_points[m.before], cache.new_points[i]));
    const double to_after = std::sqrt(squared_distance(cache.new_points[i], cache.new_points[m.after]));
    const double base = m.before == i           ? 1.0
                        : i < cache.non_steiner ? std::min(to_before, to_after) / mesh.options.resolution
                                                : interpolated_scale(cache.new_scales[m.before], to_before,
                                                                     cache.new_scales[m.after], to_after);
    cache.new_scales[i] = base * mesh.at(m.boundary).scale_factor;
  }
}

void write(MeshData& mesh, const AdjustCache& cache, const std::vector<Point>& points,
           const std::vector<double>& scales) {
  for (std::size_t i = 0; i < cache.moving.size(); ++i)
    mesh.triangulation.move(cache.moving[i].vertex, points[i], scales[i]);
}

bool counterclockwise(const Triangulation& t, const VertexId (&v)[3]) {
  return orient2d(t.point(v[0]), t.point(v[1]), t.point(v[2])) > 0;
}

// Sets good and circle of the affected triangles in the domain. Whether all are good.
bool evaluate_domain(const MeshData& mesh, AdjustCache& cache) {
  const Triangulation& triangulation = mesh.triangulation;
  const QualityBounds bounds = mesh.promised_bounds();
  const std::vector<std::uint32_t>& list = cache.in_domain;
  Lanes lanes;
  bool all = true;
  for (std::size_t begin = 0; begin < list.size(); begin += Lanes::count) {
    const std::size_t end = std::min(begin + Lanes::count, list.size());
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const Affected& a = cache.affected[list[std::min(begin + lane, end - 1)]];
      lanes.load(lane, triangulation[a.vertex[0]], triangulation[a.vertex[1]], triangulation[a.vertex[2]]);
    }
    lanes.judge(bounds);
    for (std::size_t i = begin; i < end; ++i) {
      Affected& a = cache.affected[list[i]];
      a.circle = lanes.circle(i - begin);
      a.good = lanes.good(i - begin);
      all &= a.good;
    }
  }
  return all;
}

// Sets good and circle of every affected triangle, the mesh being at the new positions.
bool evaluate(const MeshData& mesh, AdjustCache& cache) {
  const Triangulation& triangulation = mesh.triangulation;
  bool all = evaluate_domain(mesh, cache);
  for (Affected& a : cache.affected) {
    if (a.domain) continue;
    a.good = counterclockwise(triangulation, a.vertex);
    all &= a.good;
  }
  for (const AdjustCache::Edge& edge : cache.edges) {
    Affected& a = cache.affected[edge.affected];
    const Point apex = triangulation.point(edge.apex);
    const double d = squared_distance(a.circle.centre, apex);
    if (d > a.circle.outside) continue;
    const bool conflict = d < a.circle.inside || !counterclockwise(triangulation, a.vertex) ||
                          incircle_sos(triangulation.point(a.vertex[0]), triangulation.point(a.vertex[1]),
                                       triangulation.point(a.vertex[2]), apex) > 0;
    if (!conflict) continue;
    a.good = all = false;
    if (edge.across != no_index) cache.affected[edge.across].good = false;
  }
  for (const AdjustCache::Segment& s : cache.segments) {
    if (encroaches(triangulation.point(s.apex), triangulation.point(s.a), triangulation.point(s.b)))
      cache.affected[s.affected].good = all = false;
  }
  return all;
}

void mark_moved(AdjustCache& cache) {
  for (Affected& a : cache.affected) a.moved = a.movable;
  for (std::size_t i = 0; i < cache.moving.size(); ++i) {
    if (cache.changes_place(i)) continue;
    const Moving& m = cache.moving[i];
    for (std::size_t s = m.star_begin; s < m.star_end; ++s) --cache.affected[cache.stars[s]].moved;
  }
}

// Whether vertex i may move now: its triangles are good at the new positions, and valid in the state between.
bool may_move(const MeshData& mesh, const AdjustCache& cache, std::size_t i) {
  const Moving& m = cache.moving[i];
  const Triangulation& triangulation = mesh.triangulation;
  for (std::size_t s = m.star_begin; s < m.star_end; ++s) {
    const Affected& a = cache.affected[cache.stars[s]];
    if (!a.good) return false;
    if (a.movable == 1) continue;  // it is as it was, or as it will be
    Point p[3];
    for (int k = 0; k < 3; ++k)
      p[k] = a.vertex[k] == m.vertex ? cache.new_points[i] : triangulation.point(a.vertex[k]);
    if (orient2d(p[0], p[1], p[2]) <= 0) return false;
  }
  return true;
}

}  // namespace

bool AdjustCache::finite() const {
  return std::all_of(new_points.begin(), new_points.end(),
                     [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

void AdjustCache::forget_connectivity() {
  affected.clear();
  in_domain.clear();
  stars.clear();
  edges.clear();
  segments.clear();
}

bool same_basis(const CstAirfoil& a, const CstAirfoil& b) {
  return a.upper.size() == b.upper.size() && a.e1 == b.e1 && a.e2 == b.e2;
}

AdjustCache& adjust_cache(MeshData& mesh, std::span<const std::size_t> moving_loops) {
  auto* present = dynamic_cast<AdjustCache*>(mesh.cache.get());
  if (present == nullptr || !std::ranges::equal(present->loops, moving_loops)) {
    auto made = std::make_unique<AdjustCache>();
    made->loops.assign(moving_loops.begin(), moving_loops.end());
    made->stale = true;
    present = made.get();
    mesh.cache = std::move(made);
  }
  if (!present->stale) return *present;
  present->forget_connectivity();
  list_moving(mesh, *present);
  list_affected(mesh, *present);
  list_edges(mesh, *present);
  present->stale = false;
  return *present;
}

void place_moving(const MeshData& mesh, AdjustCache& cache, const Domain& domain) {
  copy_shapes(cache, domain);
  place(mesh, cache, domain);
  scale(mesh, cache);
}

bool adjust_all(MeshData& mesh, AdjustCache& cache, const Domain& domain) {
  place_moving(mesh, cache, domain);
  write(mesh, cache, cache.new_points, cache.new_scales);
  if (!evaluate(mesh, cache)) {
    write(mesh, cache, cache.old_points, cache.old_scales);
    return false;
  }
  mark_moved(cache);
  cache.changed = 0;
  for (const Affected& a : cache.affected) {
    if (!a.moved) continue;
    if (a.domain) ++cache.changed;
    const Circle& circle = a.domain ? a.circle : mesh.triangulation[a.triangle].circle;
    mesh.triangulation.set_moved(a.triangle, circle, mesh.step + 1);
  }
  return true;
}

void adjust_some(MeshData& mesh, AdjustCache& cache) {
  mark_moved(cache);
  cache.accepted.assign(cache.moving.size(), false);
  for (std::size_t i = 0; i < cache.moving.size(); ++i) {
    const Moving& m = cache.moving[i];
    const bool between_lost =
        i >= cache.non_steiner && !(cache.accepted[m.before] && cache.accepted[m.after]);
    cache.accepted[i] = !between_lost && may_move(mesh, cache, i);
    const Point p = cache.accepted[i] ? cache.new_points[i] : cache.old_points[i];
    mesh.triangulation.move(m.vertex, p, cache.new_scales[i]);
  }
}

}  // namespace remodel
