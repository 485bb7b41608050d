#include "step/replace.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generate/recovery_error.h"
#include "mesh/renew_policy.h"

namespace remodel {

double least_radius(const ReplaceOptions& options, Point centre, Point before, Point after) {
  const auto [nearer, farther] =
      std::minmax({squared_distance(centre, before), squared_distance(centre, after)});
  return std::sqrt(options.renewing ? nearer : farther);
}

double lost_vertex_radius(const ReplaceOptions& options, double pair_distance, Point centre, Point before,
                          Point after) {
  const double least = least_radius(options, centre, before, after);
  const bool tight = options.renewing && pair_distance < RenewPolicy::tight_motion * least;
  return std::max(options.distance * pair_distance, tight ? RenewPolicy::tight_removal * least : least);
}

// Circles that are as they should be are not touched: most of them.
void restore_outside(MeshData& mesh) {
  Triangulation& triangulation = mesh.triangulation;
  if (!triangulation.restore_hull()) throw RecoveryError("the outermost boundary crosses itself");
  if (mesh.outside_restored) return;
  const auto marked = [&](VertexId v) { return mesh.seen_vertices.contains(v); };
  List<TriangleId> outside(&mesh.arena);
  mesh.seen_triangles.clear(triangulation.triangle_slots());
  for (const std::uint32_t head : mesh.loop_heads)
    mesh.walk(head, [&](std::uint32_t k) {
      if (marked(mesh.at(k).vertex)) return;
      triangulation.for_each_corner(mesh.at(k).vertex, [&](Corner c) {
        const Triangle& t = triangulation[c.triangle];
        if (t.region != Region::outside || t.ghost() || !mesh.seen_triangles.insert(c.triangle)) return;
        if (std::none_of(t.vertex, t.vertex + 3, marked)) outside.push_back(c.triangle);
      });
    });
  for (const TriangleId t : outside) {
    const Triangle& triangle = triangulation[t];
    const Circle circle = triangulation.circle_of(triangle.vertex[0], triangle.vertex[1], triangle.vertex[2]);
    if (!(circle == triangle.circle)) triangulation.refresh_circle(t);
  }
  triangulation.restore_delaunay(outside);
}

bool moves_outermost(const MeshData& mesh, std::span<const std::size_t> moving) {
  std::optional<std::size_t> outer;
  for (std::size_t i = 0; i < mesh.domain.loops.size(); ++i) {
    const LoopRole role = mesh.domain.loops[i].role;
    if (role == LoopRole::hole || role == LoopRole::internal) continue;
    if (outer || role != LoopRole::outer) return false;
    outer = i;
  }
  return outer && std::ranges::find(moving, *outer) != moving.end();
}

bool hull_is_open(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  return !triangulation.any_corner(infinite_vertex, [&](Corner c) {
    const Link edge = triangulation[c.triangle].link[c.index];
    return !edge.constrained() && triangulation[edge.triangle()].region == Region::outside;
  });
}

void open_hull(MeshData& mesh) {
  if (mesh.triangulation.open_hull()) mesh.outside_restored = false;
}

}  // namespace remodel
