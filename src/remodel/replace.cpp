#include "remodel/replace.h"

#include <algorithm>
#include <cmath>

#include "generate/recovery_error.h"

namespace remodel {

namespace {

double squared_distance_to_edge(Point p, Point a, Point b) {
  const Point e = b - a;
  const double along = dot(p - a, e), length = dot(e, e);
  if (along <= 0.0) return squared_distance(p, a);
  if (along >= length) return squared_distance(p, b);
  const double across = cross(e, p - a);
  return across * across / length;
}

// The corner of a ghost that is the infinite vertex; 3 for a finite triangle.
int infinite_corner(const Triangle& t) {
  int i = 0;
  while (i < 3 && t.vertex[i] != infinite_vertex) ++i;
  return i;
}

// A finite triangle that meets the region's disc, if one does: the one that holds the centre. For a centre
// outside the hull it is the one behind the nearest hull edge. Distances fall towards it along the hull edges
// that face the centre, since those lie in the triangle of the centre and any two of their points.
TriangleId start_of(const Triangulation& triangulation, const RemovalRegion& region) {
  TriangleId t = triangulation.locate(region.centre, region.hint).triangle;
  if (!triangulation[t].ghost()) return t;
  const auto distance = [&](TriangleId ghost) {
    const Triangle& g = triangulation[ghost];
    const int i = infinite_corner(g);
    return squared_distance_to_edge(region.centre, triangulation.point(g.vertex[next3(i)]),
                                    triangulation.point(g.vertex[previous3(i)]));
  };
  for (bool nearer = true; nearer;) {
    nearer = false;
    const Triangle& ghost = triangulation[t];
    const int i = infinite_corner(ghost);
    for (const int side : {next3(i), previous3(i)}) {
      const TriangleId next = ghost.link[side].triangle();
      if (!triangulation.in_conflict(next, region.centre) || distance(next) >= distance(t)) continue;
      t = next;
      nearer = true;
      break;
    }
  }
  const Triangle& ghost = triangulation[t];
  return ghost.link[infinite_corner(ghost)].triangle();
}

void collect(MeshData& mesh, const RemovalRegion& region, std::vector<VertexId>& found) {
  const Triangulation& triangulation = mesh.triangulation;
  const double r2 = region.radius * region.radius;
  std::vector<TriangleId> todo{start_of(triangulation, region)};
  mesh.marks.clear(triangulation.triangle_slots());
  mesh.marks.visit(todo.front().index);
  while (!todo.empty()) {
    const Triangle& t = triangulation[todo.back()];
    todo.pop_back();
    bool inside[3];
    for (int i = 0; i < 3; ++i) {
      const Vertex& v = triangulation[t.vertex[i]];
      inside[i] = squared_distance(v.point, region.centre) < r2;
      if (inside[i] && v.boundary == no_index && mesh.vertex_marks.visit(t.vertex[i].index))
        found.push_back(t.vertex[i]);
    }
    for (int i = 0; i < 3; ++i) {
      const TriangleId next = t.link[i].triangle();
      if (mesh.marks.visited(next.index)) continue;
      // An edge with an end inside meets the disc; only the others need their distance.
      const bool meets = inside[next3(i)] || inside[previous3(i)] ||
                         squared_distance_to_edge(region.centre, triangulation.point(t.vertex[next3(i)]),
                                                  triangulation.point(t.vertex[previous3(i)])) < r2;
      if (!meets || triangulation[next].ghost()) continue;
      mesh.marks.visit(next.index);
      todo.push_back(next);
    }
  }
}

}  // namespace

std::vector<VertexId> vertices_inside(MeshData& mesh, const std::vector<RemovalRegion>& regions) {
  std::vector<VertexId> found;
  mesh.vertex_marks.clear(mesh.triangulation.vertex_slots());
  for (const RemovalRegion& region : regions) collect(mesh, region, found);
  return found;
}

double removal_radius(const ReplaceOptions& options, double pair_distance, Point centre, Point before,
                      Point after) {
  const auto [nearer, farther] =
      std::minmax({squared_distance(centre, before), squared_distance(centre, after)});
  return std::max(options.distance * pair_distance, std::sqrt(options.renewing ? nearer : farther));
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
  std::vector<TriangleId> outside;
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
