#include "mesh/mesh_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace remodel {

QualityBounds::QualityBounds(const QualityOptions& options) {
  constexpr double margin = 1.0 - 2e-9;  // on squares
  const double sine = std::sin(options.min_angle_deg * std::numbers::pi / 180.0);
  const double infinity = std::numeric_limits<double>::infinity();
  squared_radius_edge = sine > 0.0 ? margin * 0.25 / (sine * sine) : infinity;
  squared_gradation = margin * options.max_gradation * options.max_gradation;
}

QualityBounds QualityBounds::of_refinement(const QualityOptions& options) {
  QualityOptions stricter = options;
  stricter.min_angle_deg = std::max(options.min_angle_deg, options.refine_angle_deg);
  return QualityBounds(stricter);
}

double badness(const Vertex& a, const Vertex& b, const Vertex& c, double squared_radius,
               const QualityBounds& bounds) {
  const double shortest = std::min({squared_distance(a.point, b.point), squared_distance(b.point, c.point),
                                    squared_distance(c.point, a.point)});
  const double mean = (a.length_scale + b.length_scale + c.length_scale) * (1.0 / 3.0);
  return std::max(squared_radius / (bounds.squared_radius_edge * shortest),
                  squared_radius / (bounds.squared_gradation * (mean * mean)));
}

double badness(const Triangulation& triangulation, const Triangle& t, const QualityBounds& bounds) {
  return badness(triangulation[t.vertex[0]], triangulation[t.vertex[1]], triangulation[t.vertex[2]],
                 t.circle.squared_radius(), bounds);
}

MeshData::MeshData(const MeshData& other)
    : triangulation(other.triangulation),
      domain(other.domain),
      options(other.options),
      boundary(other.boundary),
      free_boundary(other.free_boundary),
      loop_heads(other.loop_heads),
      domain_on_left(other.domain_on_left),
      domain_triangles(other.domain_triangles),
      step(other.step),
      imported(other.imported) {
  if (triangulation.journalling()) triangulation.commit();
}

double MeshData::end_parameter(std::uint32_t k) const {
  const BoundaryVertex& from = boundary[k];
  const BoundaryVertex& to = boundary[from.next];
  return to.curve == from.curve && to.t > from.t ? to.t : 1.0;
}

std::uint32_t MeshData::add_boundary_vertex(BoundaryVertex vertex, std::uint32_t previous) {
  auto k = static_cast<std::uint32_t>(boundary.size());
  if (free_boundary.empty()) {
    boundary.emplace_back();
  } else {
    k = free_boundary.back();
    free_boundary.pop_back();
  }
  vertex.previous = previous == no_index ? k : previous;
  vertex.next = previous == no_index ? k : boundary[previous].next;
  boundary[k] = vertex;
  boundary[vertex.next].previous = k;
  boundary[vertex.previous].next = k;
  triangulation.set_boundary(vertex.vertex, k);
  return k;
}

void MeshData::remove_boundary_vertex(std::uint32_t k) {
  boundary[boundary[k].previous].next = boundary[k].next;
  boundary[boundary[k].next].previous = boundary[k].previous;
  boundary[k] = {};
  free_boundary.push_back(k);
}

void MeshData::orient_loops() {
  domain_on_left.clear();
  for (std::size_t loop = 0; loop < loop_heads.size(); ++loop) {
    const Point origin = point(loop_heads[loop]);
    double twice_area = 0.0;
    std::uint32_t k = loop_heads[loop];
    do {
      twice_area += cross(point(k) - origin, point(boundary[k].next) - origin);
      k = boundary[k].next;
    } while (k != loop_heads[loop]);
    domain_on_left.push_back((twice_area > 0.0) == (domain.loops[loop].role == LoopRole::outer));
  }
}

void MeshData::label_regions() {
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i)
    if (triangulation[TriangleId{i}].alive()) triangulation.set_region(TriangleId{i}, Region::unknown);
  std::vector<TriangleId> todo;
  const auto label = [&](TriangleId t, Region region) {
    if (triangulation[t].region != Region::unknown) return;
    triangulation.set_region(t, region);
    todo.push_back(t);
  };
  for (std::size_t loop = 0; loop < loop_heads.size(); ++loop) {
    const bool left = domain_on_left[loop];
    std::uint32_t k = loop_heads[loop];
    do {
      const Corner c = *triangulation.find_edge(boundary[k].vertex, next(k).vertex);
      label(c.triangle, left ? Region::domain : Region::outside);
      label(triangulation.link(c).triangle(), left ? Region::outside : Region::domain);
      k = boundary[k].next;
    } while (k != loop_heads[loop]);
  }
  while (!todo.empty()) {
    const TriangleId t = todo.back();
    todo.pop_back();
    for (const Link link : triangulation[t].link)
      if (!link.constrained()) label(link.triangle(), triangulation[t].region);
  }
}

void MeshData::count_domain_triangles() {
  domain_triangles = 0;
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (t.alive() && t.region == Region::domain) ++domain_triangles;
  }
}

std::uint32_t MeshData::non_steiner_before(std::uint32_t k) const {
  do k = boundary[k].previous;
  while (boundary[k].steiner);
  return k;
}

std::uint32_t MeshData::non_steiner_after(std::uint32_t k) const {
  do k = boundary[k].next;
  while (boundary[k].steiner);
  return k;
}

double MeshData::base_length_scale(std::uint32_t k) const {
  const std::uint32_t before = non_steiner_before(k), after = non_steiner_after(k);
  const double to_before = std::sqrt(squared_distance(point(before), point(k)));
  const double to_after = std::sqrt(squared_distance(point(k), point(after)));
  if (!boundary[k].steiner) return std::min(to_before, to_after) / options.resolution;
  return (length_scale(before) * to_after + length_scale(after) * to_before) / (to_before + to_after);
}

void MeshData::set_boundary_length_scale(std::uint32_t k, double value) {
  triangulation.set_length_scale(boundary[k].vertex, value);
  boundary[k].scale_factor = value / base_length_scale(k);
}

}  // namespace remodel
