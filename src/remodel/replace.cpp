#include "remodel/replace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/recovery_error.h"

namespace remodel {

double least_radius(const ReplaceOptions& options, Point centre, Point before, Point after) {
  const auto [nearer, farther] =
      std::minmax({squared_distance(centre, before), squared_distance(centre, after)});
  return std::sqrt(options.renewing ? nearer : farther);
}

double lost_vertex_radius(const ReplaceOptions& options, double pair_distance, Point centre, Point before,
                          Point after) {
  constexpr double hardly = 0.3, more = std::numbers::sqrt2;
  const double least = least_radius(options, centre, before, after);
  const bool tight = options.renewing && pair_distance < hardly * least;
  return std::max(options.distance * pair_distance, tight ? more * least : least);
}

VertexId insert_boundary_point(Triangulation& triangulation, Point p, TriangleId hint) {
  for (;;) {
    const auto inserted = triangulation.insert(p, hint);
    if (inserted.is_new && triangulation.at_constraint(inserted.vertex))
      throw RecoveryError("a boundary vertex of the new design lies on another boundary edge");
    if (inserted.is_new) return inserted.vertex;
    if (triangulation[inserted.vertex].boundary != no_index)
      throw RecoveryError("two boundary vertices of the new design lie at one point");
    const Corner c = triangulation.star(inserted.vertex);
    const VertexId neighbour = triangulation.following(c) == infinite_vertex ? triangulation.preceding(c)
                                                                             : triangulation.following(c);
    triangulation.remove(inserted.vertex);
    hint = triangulation.star(neighbour).triangle;
  }
}

void restore_outside(MeshData& mesh) {
  Triangulation& triangulation = mesh.triangulation;
  List<TriangleId> outside(&mesh.arena);
  mesh.marks.clear(triangulation.triangle_slots());
  for (const std::uint32_t head : mesh.loop_heads)
    mesh.walk(head, [&](std::uint32_t k) {
      triangulation.for_each_corner(mesh.at(k).vertex, [&](Corner c) {
        const Triangle& t = triangulation[c.triangle];
        if (t.region == Region::outside && !t.ghost() && mesh.marks.visit(c.triangle.index))
          outside.push_back(c.triangle);
      });
    });
  for (const TriangleId t : outside) triangulation.refresh_circle(t);
  triangulation.restore_delaunay(outside);
}

}  // namespace remodel
