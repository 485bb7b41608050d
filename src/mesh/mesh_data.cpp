#include "mesh/mesh_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace remodel {

QualityBounds::QualityBounds(const QualityOptions& options, double keep) {
  constexpr double margin = 1.0 - 2e-9;  // on squares
  const double sine = std::sin(options.min_angle_deg * std::numbers::pi / 180.0);
  const double infinity = std::numeric_limits<double>::infinity();
  squared_radius_edge = sine > 0.0 ? margin * 0.25 / (sine * sine) : infinity;
  const double gradation = keep * options.max_gradation;
  squared_gradation = margin * gradation * gradation;
}

QualityBounds QualityBounds::of_refinement(const QualityOptions& options) {
  QualityOptions stricter = options;
  stricter.min_angle_deg = std::max(options.min_angle_deg, options.refine_angle_deg);
  return {stricter, 1.0};
}

double badness(const Vertex& a, const Vertex& b, const Vertex& c, double squared_radius,
               const QualityBounds& bounds) {
  const double shortest = squared_shortest_edge(a.point, b.point, c.point);
  const double mean = (a.length_scale + b.length_scale + c.length_scale) * (1.0 / 3.0);
  return std::max(squared_radius / (bounds.squared_radius_edge * shortest),
                  squared_radius / (bounds.squared_gradation * (mean * mean)));
}

double badness(const Triangulation& triangulation, const Triangle& t, const QualityBounds& bounds) {
  return badness(triangulation[t.vertex[0]], triangulation[t.vertex[1]], triangulation[t.vertex[2]],
                 t.circle.squared_radius(), bounds);
}

TriangleMeasures measure(const Triangulation& triangulation, const Triangle& t) {
  double shortest = INFINITY, product = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double l = squared_distance(triangulation.point(t.vertex[next3(k)]),
                                      triangulation.point(t.vertex[previous3(k)]));
    shortest = std::min(shortest, l);
    product *= l;
  }
  const Point a = triangulation.point(t.vertex[0]);
  const double twice_area = cross(triangulation.point(t.vertex[1]) - a, triangulation.point(t.vertex[2]) - a);
  return {product / (4.0 * twice_area * twice_area), shortest};
}

double angle_of(double squared_ratio) {
  return squared_ratio > 0.0 ? std::asin(0.5 / std::sqrt(squared_ratio)) * 180.0 / std::numbers::pi : 0.0;
}

MeshData::MeshData(const MeshData& other)
    : triangulation(other.triangulation),
      domain(other.domain),
      options(other.options),
      boundary(other.boundary),
      loop_heads(other.loop_heads),
      sides(other.sides),
      domain_triangles(other.domain_triangles),
      step(other.step),
      keep(other.keep),
      stopped(other.stopped),
      renewal(other.renewal),
      imported(other.imported),
      reference(other.reference),
      delaunay_slack_deg(other.delaunay_slack_deg),
      curve_places_(other.curve_places_) {
  if (!triangulation.journalling()) return;
  triangulation.commit();
  boundary.commit();
}

void MeshData::index_curves() {
  curve_places_.clear();
  for (std::uint32_t loop = 0; loop < domain.loops.size(); ++loop)
    for (std::uint32_t position = 0; position < domain.loops[loop].curves.size(); ++position)
      curve_places_.push_back({loop, position});
}

std::uint32_t MeshData::edge_between(VertexId a, VertexId b) const {
  const std::uint32_t first = triangulation[a].boundary;
  if (first == no_index) return no_index;
  std::uint32_t found = no_index;
  at_vertex(first, [&](std::uint32_t k) {
    const std::uint32_t next = boundary[k].next, previous = boundary[k].previous;
    if (next != no_index && boundary[next].vertex == b) found = k;
    if (previous != no_index && boundary[previous].vertex == b) found = previous;
  });
  return found;
}

double MeshData::end_parameter(std::uint32_t k) const {
  const BoundaryVertex& from = boundary[k];
  const BoundaryVertex& to = boundary[from.next];
  return to.curve == from.curve && to.t > from.t ? to.t : 1.0;
}

std::uint32_t MeshData::add_boundary_vertex(BoundaryVertex vertex, std::uint32_t previous) {
  const std::uint32_t k = boundary.add();
  const std::uint32_t next = previous == no_index ? no_index : boundary[previous].next;
  vertex.previous = previous;
  vertex.next = next;
  vertex.twin = k;
  const std::uint32_t station_before = previous == no_index ? no_index : boundary[previous].station;
  vertex.station = vertex.steiner ? station_before : k;
  vertex.previous_station = vertex.steiner ? no_index : station_before;
  vertex.next_station = no_index;
  if (!vertex.steiner && station_before != no_index) boundary.edit(station_before).next_station = k;
  boundary.edit(k) = vertex;
  if (previous != no_index) boundary.edit(previous).next = k;
  if (next != no_index) boundary.edit(next).previous = k;
  if (const std::uint32_t other = triangulation[vertex.vertex].boundary; other != no_index)
    std::swap(boundary.edit(k).twin, boundary.edit(other).twin);
  else
    triangulation.set_boundary(vertex.vertex, k);
  return k;
}

void MeshData::close_loop(std::uint32_t head, std::uint32_t last) {
  boundary.edit(head).previous = last;
  boundary.edit(last).next = head;
  boundary.edit(head).previous_station = boundary[last].station;
  boundary.edit(boundary[last].station).next_station = head;
}

void MeshData::remove_boundary_vertex(std::uint32_t k) {
  boundary.edit(boundary[k].previous).next = boundary[k].next;
  boundary.edit(boundary[k].next).previous = boundary[k].previous;
  boundary.drop(k);
}

namespace {

Sides sides_of(LoopRole role, bool counterclockwise) {
  constexpr Sides on_left{Region::domain, Region::outside}, on_right{Region::outside, Region::domain};
  switch (role) {
    case LoopRole::outer:
      return counterclockwise ? on_left : on_right;
    case LoopRole::hole:
      return counterclockwise ? on_right : on_left;
    case LoopRole::internal:
      return {Region::domain, Region::domain};
    case LoopRole::left:
      return on_left;
    case LoopRole::right:
      return on_right;
  }
  return {};
}

}  // namespace

void MeshData::measure_extent() const {
  Point low = point(loop_heads.front()), high = low;
  for (const std::uint32_t head : loop_heads)
    walk(head, [&](std::uint32_t k) {
      const Point p = point(k);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    });
  extent_ = std::sqrt(squared_distance(low, high));
  largest_coordinate_ = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
}

double MeshData::extent() const {
  if (extent_ < 0.0) measure_extent();
  return extent_;
}

double MeshData::shortest_edge() const {
  constexpr double usual = 1e-12, spacings = 0x1p-46;
  const double size = extent();
  const double wanted =
      options.min_edge > 0.0 ? options.min_edge : usual * std::max(size, largest_coordinate_);
  return std::max(wanted, spacings * largest_coordinate_);
}

void MeshData::orient_loops() {
  forget_extent();
  sides.resize(loop_heads.size());
  for (std::size_t loop = 0; loop < loop_heads.size(); ++loop) orient_loop(loop);
}

void MeshData::orient_loop(std::size_t loop) {
  const Point origin = point(loop_heads[loop]);
  double twice_area = 0.0;
  walk_edges(loop_heads[loop], [&](std::uint32_t k, std::uint32_t next) {
    twice_area += cross(point(k) - origin, point(next) - origin);
  });
  sides[loop] = sides_of(domain.loops[loop].role, twice_area > 0.0);
}

bool MeshData::label_regions() {
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i)
    if (triangulation[TriangleId{i}].alive()) triangulation.set_region(TriangleId{i}, Region::unknown);
  bool agreement = true;
  std::vector<TriangleId> todo;
  const auto label = [&](TriangleId t, Region region) {
    if (triangulation[t].region != Region::unknown) {
      agreement &= triangulation[t].region == region;
      return;
    }
    triangulation.set_region(t, region);
    todo.push_back(t);
  };
  const auto label_beside = [&](VertexId from, VertexId to, Region region) {
    label(triangulation.find_edge(from, to)->triangle, region);
  };
  for (std::size_t loop = 0; loop < loop_heads.size(); ++loop)
    walk_edges(loop_heads[loop], [&](std::uint32_t k, std::uint32_t next) {
      label_beside(boundary[k].vertex, boundary[next].vertex, sides[loop].left);
      label_beside(boundary[next].vertex, boundary[k].vertex, sides[loop].right);
    });
  label(triangulation.star(infinite_vertex).triangle, Region::outside);
  while (!todo.empty()) {
    const TriangleId t = todo.back();
    todo.pop_back();
    for (const Link link : triangulation[t].link)
      if (!link.constrained()) label(link.triangle(), triangulation[t].region);
  }
  return agreement;
}

std::size_t MeshData::count_domain_triangles() const {
  std::size_t count = 0;
  triangulation.for_each_domain_triangle([&](TriangleId, const Triangle&) { ++count; });
  return count;
}

double MeshData::base_length_scale(std::uint32_t k) const {
  const auto distance = [&](std::uint32_t a, std::uint32_t b) {
    return std::sqrt(squared_distance(point(a), point(b)));
  };
  if (boundary[k].steiner) {
    const std::uint32_t before = non_steiner_before(k), after = non_steiner_after(k);
    return interpolated_scale(length_scale(before), distance(before, k), length_scale(after),
                              distance(k, after));
  }
  double nearest = std::numeric_limits<double>::infinity();
  at_vertex(k, [&](std::uint32_t e) {
    for (const std::uint32_t n : {non_steiner_before(e), non_steiner_after(e)})
      if (n != no_index) nearest = std::min(nearest, distance(e, n));
  });
  return std::isfinite(nearest) ? nearest / options.resolution : 1.0;
}

bool MeshData::is_single_point(std::uint32_t k) const {
  bool single = true;
  at_vertex(k, [&](std::uint32_t e) {
    single &= boundary[e].next == no_index && boundary[e].previous == no_index;
  });
  return single;
}

void MeshData::set_boundary_length_scale(std::uint32_t k, double value) {
  triangulation.set_length_scale(boundary[k].vertex, value);
  const double factor = value / base_length_scale(k);
  at_vertex(k, [&](std::uint32_t e) { boundary.edit(e).scale_factor = factor; });
}

}  // namespace remodel
